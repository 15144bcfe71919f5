#include "myoid/ground/math/stiff_ode.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>
#include <vector>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/sundials.h"

namespace myoid::inline ground::math {
namespace {

void must(int flag) {
  if (flag < 0) throw std::bad_alloc();  // set-up calls fail only for lack of memory
}

OdeStatus status_of(int flag) {
  switch (flag) {
    case CV_TOO_MUCH_WORK:
      return OdeStatus::too_many_steps;
    case CV_TOO_MUCH_ACC:
    case CV_ERR_FAILURE:
      return OdeStatus::step_too_small;
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
    case CV_QRHSFUNC_FAIL:
    case CV_FIRST_QRHSFUNC_ERR:
    case CV_SRHSFUNC_FAIL:
    case CV_FIRST_SRHSFUNC_ERR:
      return OdeStatus::rate_failed;
    default:
      return flag < 0 ? OdeStatus::solver_failed : OdeStatus::done;
  }
}

bool finite(const double* x, std::size_t n) {
  return std::all_of(x, x + n, [](double v) { return std::isfinite(v); });
}

}  // namespace

struct StiffIntegrator::Parts {
  template <auto free>
  struct Free {
    void operator()(auto* it) const { free(it); }
  };
  /// For functions that take the address of the pointer.
  template <auto free>
  struct FreeAt {
    void operator()(auto* it) const { free(&it); }
  };
  using Context = std::unique_ptr<std::remove_pointer_t<sundials::Context>, FreeAt<sundials::free_context>>;
  using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, Free<N_VDestroy>>;
  using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, Free<SUNMatDestroy>>;
  using Solver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, Free<SUNLinSolFree>>;
  using Memory = std::unique_ptr<void, FreeAt<CVodeFree>>;

  /// Vectors of one group, with the array of pointers that the solver needs.
  struct Vectors {
    std::vector<Vector> owned;
    std::vector<N_Vector> raw;
    std::vector<const double*> in;  ///< Arguments and results of `sensitivity`.
    std::vector<double*> out;

    Vectors(std::size_t count, std::size_t length, sundials::Context context) : in(count), out(count) {
      for (std::size_t k = 0; k < count; ++k) {
        owned.emplace_back(sundials::new_vector(static_cast<sunindextype>(length), context));
        if (!owned.back()) throw std::bad_alloc();
        N_VConst(0.0, owned.back().get());
        raw.push_back(owned.back().get());
      }
    }
  };

  Context context;
  StiffProblem problem;
  OdeOptions options;
  Vector y, tolerance, quadrature, scratch, quadrature_scratch;
  std::unique_ptr<Vectors> sensitivity;
  Matrix matrix;
  Solver solver;
  Memory memory;
  double time = 0.0, previous = 0.0;
  bool restart = false;
  bool begun = false;
  bool failed = false;   ///< The rate failed after the last step with a length.
  int creeping = 0;      ///< Successive steps that hardly change the time.
  OdeStatistics before;  ///< Counts of the integrations up to the last restart.
  long events = 0;

  static int rate(double t, N_Vector y, N_Vector ydot, void* data) {
    auto& self = *static_cast<Parts*>(data);
    double* out = NV_DATA_S(ydot);
    const bool good = self.problem.rate(t, NV_DATA_S(y), out) && finite(out, self.problem.state_count);
    if (!good) self.failed = true;
    return good ? 0 : 1;
  }
  static int jacobian(double t,
                      N_Vector y,
                      N_Vector /*rate*/,
                      SUNMatrix matrix,
                      void* data,
                      N_Vector /*scratch*/,
                      N_Vector /*scratch*/,
                      N_Vector /*scratch*/) {
    auto& self = *static_cast<Parts*>(data);
    self.problem.jacobian(t, NV_DATA_S(y), SM_DATA_D(matrix));
    return 0;
  }
  static int quadrature_rate(double t, N_Vector y, N_Vector zdot, void* data) {
    auto& self = *static_cast<Parts*>(data);
    return self.problem.quadrature(t, NV_DATA_S(y), NV_DATA_S(zdot)) ? 0 : 1;
  }
  static int sensitivity_rate(int count,
                              double t,
                              N_Vector y,
                              N_Vector /*ydot*/,
                              N_Vector* s,
                              N_Vector* sdot,
                              void* data,
                              N_Vector /*scratch*/,
                              N_Vector /*scratch*/) {
    auto& self = *static_cast<Parts*>(data);
    for (int k = 0; k < count; ++k) {
      self.sensitivity->in[static_cast<std::size_t>(k)] = NV_DATA_S(s[k]);
      self.sensitivity->out[static_cast<std::size_t>(k)] = NV_DATA_S(sdot[k]);
    }
    return self.problem.sensitivity(t, NV_DATA_S(y), self.sensitivity->in.data(), self.sensitivity->out.data()) ? 0 : 1;
  }

  OdeStatistics counted() const {
    OdeStatistics s = before;
    if (begun) {
      long steps = 0, rates = 0, error_fails = 0, jacobians = 0, more = 0;
      CVodeGetNumSteps(memory.get(), &steps);
      CVodeGetNumRhsEvals(memory.get(), &rates);
      CVodeGetNumErrTestFails(memory.get(), &error_fails);
      CVodeGetNumJacEvals(memory.get(), &jacobians);
      CVodeGetNumLinRhsEvals(memory.get(), &more);
      s.steps += steps;
      s.rate_evaluations += rates + more;
      s.rejected += error_fails;
      s.jacobians += jacobians;
    }
    s.events = events;
    return s;
  }
};

StiffIntegrator::StiffIntegrator(StiffProblem problem, const OdeOptions& options) : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  validate(options, static_cast<long>(problem.state_count));
  if (problem.state_count == 0 || !problem.rate)
    throw InvalidInput("a system of differential equations needs at least one state and a rate");
  p.problem = std::move(problem);
  p.options = options;
  const sundials::Context context = sundials::new_context();
  if (context == nullptr) throw std::bad_alloc();
  p.context.reset(context);
  const auto n = static_cast<sunindextype>(p.problem.state_count);
  p.y.reset(sundials::new_vector(n, context));
  p.scratch.reset(sundials::new_vector(n, context));
  p.tolerance.reset(sundials::new_vector(n, context));
  p.matrix.reset(sundials::new_matrix(n, context));
  p.memory.reset(sundials::new_integrator(context));
  if (!p.y || !p.scratch || !p.tolerance || !p.matrix || !p.memory) throw std::bad_alloc();
  N_VConst(0.0, p.y.get());
  void* memory = p.memory.get();
  must(sundials::silence(memory));
  must(CVodeInit(memory, Parts::rate, 0.0, p.y.get()));
  must(CVodeSetUserData(memory, &p));
  for (sunindextype i = 0; i < n; ++i) {
    NV_Ith_S(p.tolerance.get(), i) = options.absolute_tolerances.empty()
                                         ? options.absolute_tolerance
                                         : options.absolute_tolerances[static_cast<std::size_t>(i)];
  }
  must(CVodeSVtolerances(memory, options.relative_tolerance, p.tolerance.get()));
  p.solver.reset(sundials::new_solver(p.y.get(), p.matrix.get(), context));
  if (!p.solver) throw std::bad_alloc();
  must(CVodeSetLinearSolver(memory, p.solver.get(), p.matrix.get()));
  if (p.problem.jacobian) must(CVodeSetJacFn(memory, Parts::jacobian));
  must(CVodeSetMaxNumSteps(memory, options.max_steps));
  if (std::isfinite(options.max_step_s)) must(CVodeSetMaxStep(memory, options.max_step_s));
  if (options.first_step_s > 0.0) must(CVodeSetInitStep(memory, options.first_step_s));
  if (p.problem.quadrature_count > 0) {
    const auto count = static_cast<sunindextype>(p.problem.quadrature_count);
    p.quadrature.reset(sundials::new_vector(count, context));
    p.quadrature_scratch.reset(sundials::new_vector(count, context));
    if (!p.quadrature || !p.quadrature_scratch) throw std::bad_alloc();
    N_VConst(0.0, p.quadrature.get());
    must(CVodeQuadInit(memory, Parts::quadrature_rate, p.quadrature.get()));
    must(CVodeQuadSStolerances(memory, options.relative_tolerance, options.absolute_tolerance));
    must(CVodeSetQuadErrCon(memory, 1));
  }
  if (p.problem.sensitivity_count > 0) {
    const std::size_t count = p.problem.sensitivity_count;
    p.sensitivity = std::make_unique<Parts::Vectors>(count, p.problem.state_count, context);
    must(CVodeSensInit(memory, static_cast<int>(count), CV_STAGGERED, Parts::sensitivity_rate,
                       p.sensitivity->raw.data()));
    std::vector<double> absolute(count, options.absolute_tolerance);
    must(CVodeSensSStolerances(memory, options.relative_tolerance, absolute.data()));
    must(CVodeSetSensErrCon(memory, 1));
  }
}

StiffIntegrator::~StiffIntegrator() = default;
StiffIntegrator::StiffIntegrator(StiffIntegrator&&) noexcept = default;
StiffIntegrator& StiffIntegrator::operator=(StiffIntegrator&&) noexcept = default;

OdeStatus StiffIntegrator::start(double time_s, std::span<const double> y, std::span<const double> s) {
  Parts& p = *parts_;
  if (y.size() != p.problem.state_count) throw InvalidInput("start: wrong number of states");
  std::copy(y.begin(), y.end(), NV_DATA_S(p.y.get()));
  if (p.quadrature) N_VConst(0.0, p.quadrature.get());
  for (std::size_t k = 0; k < p.problem.sensitivity_count; ++k) {
    double* target = NV_DATA_S(p.sensitivity->raw[k]);
    if (s.empty()) {
      std::fill(target, target + y.size(), 0.0);
    } else {
      std::copy(s.begin() + static_cast<std::ptrdiff_t>(k * y.size()),
                s.begin() + static_cast<std::ptrdiff_t>((k + 1) * y.size()), target);
    }
  }
  p.time = p.previous = time_s;
  p.restart = true;
  return OdeStatus::done;
}

OdeStatus StiffIntegrator::step(double limit_s) {
  Parts& p = *parts_;
  void* memory = p.memory.get();
  if (limit_s - p.time < 1e-13 * std::max(1.0, std::abs(p.time))) {
    // Too near for a step: the limits differ by round-off.
    renew();
    p.previous = p.time;
    p.time = limit_s;
    return OdeStatus::done;
  }
  if (p.restart) {
    p.before = p.counted();
    must(CVodeReInit(memory, p.time, p.y.get()));
    if (p.quadrature) must(CVodeQuadReInit(memory, p.quadrature.get()));
    if (p.sensitivity) must(CVodeSensReInit(memory, CV_STAGGERED, p.sensitivity->raw.data()));
    p.restart = false;
    p.begun = true;
  }
  must(CVodeSetStopTime(memory, limit_s));
  p.previous = p.time;
  double reached = p.time;
  const int flag = CVode(memory, limit_s, p.y.get(), &reached, CV_ONE_STEP);
  if (flag < 0) return status_of(flag);
  p.time = reached;
  // A solver that creeps towards a singularity would never end.
  const bool creeps = p.time - p.previous < 1e-12 * std::max(1.0, std::abs(p.time));
  p.creeping = creeps ? p.creeping + 1 : 0;
  if (p.creeping > 200) return p.failed ? OdeStatus::rate_failed : OdeStatus::step_too_small;
  if (!creeps) p.failed = false;
  if (p.counted().steps > p.options.max_steps) return OdeStatus::too_many_steps;
  return OdeStatus::done;
}

OdeStatus StiffIntegrator::shorten(double time_s) {
  Parts& p = *parts_;
  void* memory = p.memory.get();
  if (time_s < p.time) {
    must(CVodeGetDky(memory, time_s, 0, p.y.get()));
    if (p.quadrature) must(CVodeGetQuadDky(memory, time_s, 0, p.quadrature.get()));
    if (p.sensitivity) must(CVodeGetSensDky(memory, time_s, 0, p.sensitivity->raw.data()));
    p.time = time_s;
    p.restart = true;
  } else {
    renew();
  }
  ++p.events;
  return OdeStatus::done;
}

void StiffIntegrator::renew() {
  Parts& p = *parts_;
  if (p.restart) return;
  double reached = p.time;
  if (p.quadrature) must(CVodeGetQuad(p.memory.get(), &reached, p.quadrature.get()));
  if (p.sensitivity) must(CVodeGetSens(p.memory.get(), &reached, p.sensitivity->raw.data()));
  p.restart = true;
}

OdeStatus StiffIntegrator::hop(double dt_s) {
  Parts& p = *parts_;
  renew();
  const std::size_t n = p.problem.state_count;
  double* y = NV_DATA_S(p.y.get());
  std::vector<double> rate(n);
  if (!p.problem.rate(p.time, y, rate.data()) || !finite(rate.data(), n)) return OdeStatus::rate_failed;
  if (p.quadrature) {
    std::vector<double> power(p.problem.quadrature_count);
    if (!p.problem.quadrature(p.time, y, power.data())) return OdeStatus::rate_failed;
    for (std::size_t k = 0; k < power.size(); ++k) NV_DATA_S(p.quadrature.get())[k] += dt_s * power[k];
  }
  if (p.problem.sensitivity_count > 0) {
    std::vector<double> change(n * p.problem.sensitivity_count);
    for (std::size_t k = 0; k < p.problem.sensitivity_count; ++k) {
      p.sensitivity->in[k] = NV_DATA_S(p.sensitivity->raw[k]);
      p.sensitivity->out[k] = change.data() + k * n;
    }
    if (!p.problem.sensitivity(p.time, y, p.sensitivity->in.data(), p.sensitivity->out.data()))
      return OdeStatus::rate_failed;
    for (std::size_t k = 0; k < p.problem.sensitivity_count; ++k) {
      for (std::size_t i = 0; i < n; ++i) NV_DATA_S(p.sensitivity->raw[k])[i] += dt_s * change[k * n + i];
    }
  }
  for (std::size_t i = 0; i < n; ++i) y[i] += dt_s * rate[i];
  p.previous = p.time;
  p.time += dt_s;
  p.creeping = 0;
  return OdeStatus::done;
}

double StiffIntegrator::time_s() const { return parts_->time; }
double StiffIntegrator::previous_time_s() const { return parts_->previous; }
std::size_t StiffIntegrator::size() const { return parts_->problem.state_count; }
std::span<const double> StiffIntegrator::state() const {
  return {NV_DATA_S(parts_->y.get()), parts_->problem.state_count};
}
OdeStatistics StiffIntegrator::statistics() const { return parts_->counted(); }

void StiffIntegrator::interpolate(double time_s, std::span<double> y) const {
  if (!parts_->begun || time_s == parts_->time) {
    std::copy(state().begin(), state().end(), y.begin());
    return;
  }
  must(CVodeGetDky(parts_->memory.get(), time_s, 0, parts_->scratch.get()));
  std::copy_n(NV_DATA_S(parts_->scratch.get()), y.size(), y.begin());
}

void StiffIntegrator::interpolate_quadrature(double time_s, std::span<double> z) const {
  Parts& p = *parts_;
  N_Vector from = p.quadrature.get();
  if (p.begun && !(p.restart && time_s == p.time)) {
    must(CVodeGetQuadDky(p.memory.get(), time_s, 0, p.quadrature_scratch.get()));
    from = p.quadrature_scratch.get();
  }
  std::copy_n(NV_DATA_S(from), z.size(), z.begin());
}

void StiffIntegrator::interpolate_sensitivity(double time_s, std::span<double> s) const {
  Parts& p = *parts_;
  const std::size_t n = p.problem.state_count;
  for (std::size_t k = 0; k < p.problem.sensitivity_count; ++k) {
    const double* from = NV_DATA_S(p.sensitivity->raw[k]);
    if (p.begun && !(p.restart && time_s == p.time)) {
      must(CVodeGetSensDky1(p.memory.get(), time_s, 0, static_cast<int>(k), p.scratch.get()));
      from = NV_DATA_S(p.scratch.get());
    }
    std::copy_n(from, n, s.begin() + static_cast<std::ptrdiff_t>(k * n));
  }
}

}  // namespace myoid::inline ground::math
