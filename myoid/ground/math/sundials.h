#pragma once

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#if SUNDIALS_VERSION_MAJOR >= 6
#include <sundials/sundials_context.h>
#endif

/// The calls of SUNDIALS 5, 6 and 7 under one signature. Version 6 brought the context that every object takes;
/// since version 7 messages of errors belong to the context too, and no message has the type of a communicator.
namespace myoid::inline ground::math::sundials {

#if SUNDIALS_VERSION_MAJOR >= 6
using Context = SUNContext;
inline void free_context(Context* context) { SUNContext_Free(context); }
#define MYOID_IN_CONTEXT(context) , context
#else
/// Version 5 has no contexts: this one holds nothing.
struct NoContext {};
using Context = NoContext*;
inline void free_context(Context* context) {
  delete *context;
  *context = nullptr;
}
#define MYOID_IN_CONTEXT(context)
#endif

/// Returns a null pointer if there is no memory.
inline Context new_context() {
#if SUNDIALS_VERSION_MAJOR >= 7
  Context context = nullptr;
  if (SUNContext_Create(SUN_COMM_NULL, &context) != 0) return nullptr;
  SUNContext_ClearErrHandlers(context);
  return context;
#elif SUNDIALS_VERSION_MAJOR == 6
  Context context = nullptr;
  return SUNContext_Create(nullptr, &context) == 0 ? context : nullptr;
#else
  return new NoContext;
#endif
}

inline N_Vector new_vector(sunindextype length, [[maybe_unused]] Context context) {
  return N_VNew_Serial(length MYOID_IN_CONTEXT(context));
}
inline SUNMatrix new_matrix(sunindextype size, [[maybe_unused]] Context context) {
  return SUNDenseMatrix(size, size MYOID_IN_CONTEXT(context));
}
inline SUNLinearSolver new_solver(N_Vector vector, SUNMatrix matrix, [[maybe_unused]] Context context) {
  return SUNLinSol_Dense(vector, matrix MYOID_IN_CONTEXT(context));
}
/// Makes an integrator by backward differentiation.
inline void* new_integrator([[maybe_unused]] Context context) { return CVodeCreate(CV_BDF MYOID_IN_CONTEXT(context)); }
#undef MYOID_IN_CONTEXT

/// The integrator prints nothing: its flags say everything. Returns a flag.
inline int silence(void* integrator) {
#if SUNDIALS_VERSION_MAJOR < 7
  const int flag = CVodeSetErrHandlerFn(
      integrator, [](int, const char*, const char*, char*, void*) {}, nullptr);
  if (flag < 0) return flag;
#endif
  return CVodeSetMaxHnilWarns(integrator, -1);
}

}  // namespace myoid::inline ground::math::sundials
