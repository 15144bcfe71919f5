#pragma once

#include <Eigen/Core>

namespace myoid::body {

/// The controls x of given actuators that produce given generalized forces.
///
///   minimize  sum_i |x_i|^p   subject to  A x = b,   lower <= x <= upper
///
/// A column of A is the generalized force of an actuator at x = 1; bounds may be infinite.
struct ActuatorProblem {
  Eigen::MatrixXd forces;    ///< A: rows x actuators [N m, N].
  Eigen::VectorXd required;  ///< b [N m, N]
  Eigen::VectorXd lower, upper;
  double exponent = 2.0;  ///< p > 1
};

struct ActuatorSolution {
  Eigen::VectorXd control;     ///< x
  Eigen::VectorXd multiplier;  ///< lambda, of A x = b.
  /// Greatest violation of the optimality conditions, each relative to the greatest term in it: balance of every row, p
  /// |x|^(p-1) sign x = A' lambda for a free control, its right sign at a bound.
  double kkt_residual = 0.0;
  int iterations = 0;
  bool solved = false;   ///< Certified: kkt_residual <= 1e-9.
  bool feasible = true;  ///< Otherwise: the controls that come nearest.
};

/// Solves by Newton's method on the concave dual: given lambda, every control follows in closed form, x_i = clip((A'
/// lambda)_i / p)^(1/(p-1)). Exact to round-off if the actuators can produce b. Where that law is too steep (large
/// exponents), Newton's method on the controls raises the exponent step by step from 2. Otherwise a penalty of 1e6
/// times the cost of the greatest control distributes the rest, and `feasible` is false: no exponent changes that.
/// Throws InvalidInput if sizes disagree, p
/// <= 1 or a bound lies above the other.
[[nodiscard]] ActuatorSolution solve_actuators(const ActuatorProblem& problem, const Eigen::VectorXd* start = nullptr);

}  // namespace myoid::body
