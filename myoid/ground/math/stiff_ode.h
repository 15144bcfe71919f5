#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "myoid/ground/math/ode.h"

namespace myoid::inline ground::math {

/// A system of ordinary differential equations for `StiffIntegrator`; functions write their result
/// to the last argument.
struct StiffProblem {
  std::size_t state_count = 0;
  /// Computes dy/dt; false if it cannot be evaluated: the step is then repeated with a shorter length.
  std::function<bool(double t, const double* y, double* ydot)> rate;
  /// Computes df/dy, column by column; without this function differences approximate it.
  std::function<void(double t, const double* y, double* jacobian)> jacobian;

  /// Number of integrals over time of functions of the states, dz/dt; the integrals do not act on the states.
  std::size_t quadrature_count = 0;
  std::function<bool(double t, const double* y, double* zdot)> quadrature;

  /// Derivatives of the states by parameters, s_k = dy/dp_k: ds_k/dt = (df/dy) s_k + df/dp_k. `s`
  /// and `sdot` hold one array of states per parameter. The tolerances of the states apply, so that
  /// a parameter's unit should make its derivatives as large as the states.
  std::size_t sensitivity_count = 0;
  std::function<bool(double t, const double* y, const double* const* s, double* const* sdot)> sensitivity;
};

/// Backward differentiation formulas of variable order (1 to 5) and step with Newton's method, by SUNDIALS' CVODES. For
/// stiff problems. Like `RungeKutta` it gives the steps one by one, with an interpolant over the last one.
class StiffIntegrator {
 public:
  /// Throws InvalidInput if the options do not fit the problem.
  StiffIntegrator(StiffProblem problem, const OdeOptions& options);
  ~StiffIntegrator();
  StiffIntegrator(StiffIntegrator&&) noexcept;
  StiffIntegrator& operator=(StiffIntegrator&&) noexcept;

  /// Begins at y(t), with all integrals 0 and with derivatives `s` (by parameter; empty: 0).
  OdeStatus start(double time_s, std::span<const double> y, std::span<const double> s = {});
  /// Makes one step, at most to `limit_s`, beyond which nothing is evaluated.
  OdeStatus step(double limit_s);
  /// Shortens the last step to end at `time_s` within it, a kink of the right-hand side; the next
  /// step starts the method anew.
  OdeStatus shorten(double time_s);
  /// Restarts after a jump of the right-hand side at the present time.
  void renew();
  /// Makes one explicit step of `dt_s` without error control and restarts after it: past an
  /// unannounced jump of the right-hand side, after `step_too_small`.
  OdeStatus hop(double dt_s);

  [[nodiscard]] double time_s() const;
  [[nodiscard]] double previous_time_s() const;
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::span<const double> state() const;
  [[nodiscard]] OdeStatistics statistics() const;

  /// Returns y at a time within the last step (not within a hop).
  void interpolate(double time_s, std::span<double> y) const;
  void interpolate_quadrature(double time_s, std::span<double> z) const;
  /// Returns the derivatives by parameter.
  void interpolate_sensitivity(double time_s, std::span<double> s) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace myoid::inline ground::math
