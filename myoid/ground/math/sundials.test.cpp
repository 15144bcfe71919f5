#include "myoid/ground/math/sundials.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::inline ground::math::sundials {
namespace {

TEST(Sundials, AnIntegratorOfTheseCallsFollowsADecay) {
  Context context = new_context();
  ASSERT_NE(context, nullptr);
  N_Vector y = new_vector(1, context);
  NV_Ith_S(y, 0) = 1.0;
  SUNMatrix matrix = new_matrix(1, context);
  void* integrator = new_integrator(context);
  ASSERT_NE(integrator, nullptr);
  EXPECT_GE(silence(integrator), 0);
  const auto decay = [](double, N_Vector state, N_Vector rate, void*) {
    NV_Ith_S(rate, 0) = -NV_Ith_S(state, 0);
    return 0;
  };
  ASSERT_GE(CVodeInit(integrator, decay, 0.0, y), 0);
  ASSERT_GE(CVodeSStolerances(integrator, 1e-10, 1e-12), 0);
  SUNLinearSolver solver = new_solver(y, matrix, context);
  ASSERT_GE(CVodeSetLinearSolver(integrator, solver, matrix), 0);
  double reached = 0.0;
  ASSERT_GE(CVode(integrator, 2.0, y, &reached, CV_NORMAL), 0);
  EXPECT_NEAR(NV_Ith_S(y, 0), std::exp(-2.0), 1e-8);  // some hundred steps of 1e-10 each
  CVodeFree(&integrator);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(y);
  free_context(&context);
}

}  // namespace
}  // namespace myoid::inline ground::math::sundials
