#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "myoid/math/ode.h"

namespace myoid::math {

/// A system of ordinary differential equations for `StiffIntegrator`; functions write their result
/// through the last argument.
struct StiffProblem {
  std::size_t state_count = 0;
  /// dy/dt; false: cannot be evaluated there, the step is tried shorter.
  std::function<bool(double t, const double* y, double* ydot)> rate;
  /// df/dy, column by column; without one it is found by differences.
  std::function<void(double t, const double* y, double* jacobian)> jacobian;

  /// Integrals over time of functions of the states, which do not act back: dz/dt.
  std::size_t quadrature_count = 0;
  std::function<bool(double t, const double* y, double* zdot)> quadrature;

  /// Derivatives of the states by parameters, s_k = dy/dp_k: ds_k/dt = (df/dy) s_k + df/dp_k.
  /// `s` and `sdot`: one array of states per parameter. They are held to the same tolerances, so
  /// choose the unit of a parameter such that its derivatives are of the size of the states.
  std::size_t sensitivity_count = 0;
  std::function<bool(double t, const double* y, const double* const* s, double* const* sdot)>
      sensitivity;
};

/// Backward differentiation formulas of variable order (1 to 5) and step with Newton's method:
/// SUNDIALS' CVODES, owned. For stiff problems. Its steps are seen one by one, with an interpolant
/// over the last one, as those of `RungeKutta`.
class StiffIntegrator {
 public:
  /// Throws InvalidInput if the options do not fit the problem.
  StiffIntegrator(StiffProblem problem, const OdeOptions& options);
  ~StiffIntegrator();
  StiffIntegrator(StiffIntegrator&&) noexcept;
  StiffIntegrator& operator=(StiffIntegrator&&) noexcept;

  /// Begins at y(t), with all integrals 0 and with derivatives `s` (parameter by parameter; empty:
  /// 0).
  OdeStatus start(double time_s, std::span<const double> y, std::span<const double> s = {});
  /// One step, ending at `limit_s` at the latest, beyond which nothing is evaluated.
  OdeStatus step(double limit_s);
  /// Ends the last step earlier, at `time_s` within it; the next one starts anew from there, since
  /// the right-hand side has a kink.
  OdeStatus shorten(double time_s);
  /// The right-hand side jumps at the present time.
  void renew();
  /// One explicit step of `dt_s` without control of its error, and a new beginning there: after
  /// `step_too_small`, past a jump of the right-hand side that nobody announced.
  OdeStatus hop(double dt_s);

  [[nodiscard]] double time_s() const;
  [[nodiscard]] double previous_time_s() const;
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::span<const double> state() const;
  [[nodiscard]] OdeStatistics statistics() const;

  /// At a time within the last step (not within a hop).
  void interpolate(double time_s, std::span<double> y) const;
  void interpolate_quadrature(double time_s, std::span<double> z) const;
  /// Parameter by parameter.
  void interpolate_sensitivity(double time_s, std::span<double> s) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace myoid::math
