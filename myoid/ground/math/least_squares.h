#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"

namespace myoid::inline ground::math {

/// Computes residuals and, if `jacobian` is not null, their derivatives at x. The caller sets the
/// sizes: r has `residual_count` entries, J is residual_count x parameter_count.
using ResidualFunction =
    std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian)>;

struct LeastSquaresProblem {
  Eigen::Index residual_count = 0;
  ResidualFunction evaluate;
  Eigen::VectorXd lower;  ///< Empty, or one per parameter; -inf without a bound.
  Eigen::VectorXd upper;  ///< Empty, or one per parameter; +inf without a bound.
};

enum class LeastSquaresMethod {
  gauss_newton,         ///< Full steps d of J d = -r by column-pivoted QR without damping, as in the
                        ///< source paper.
  levenberg_marquardt,  ///< More's scaled trust region, projected onto the bounds.
};

struct LeastSquaresOptions {
  LeastSquaresMethod method = LeastSquaresMethod::levenberg_marquardt;
  int max_iterations = 200;
  double initial_radius = 3.0;        ///< Radius of the trust region at the start, in units of |D x|.
  double step_tolerance = 1e-12;      ///< Stop when |d| <= tol (|x| + tol), in scaled variables.
  double cost_tolerance = 1e-15;      ///< Stop when the cost falls by less than this share.
  double gradient_tolerance = 1e-14;  ///< Stop when all |cos(free J column, r)| are below.
  Progress progress;
};

/// Reason for the end of the search. Only `converged` is an answer.
enum class Termination { converged, iteration_limit, no_descent, not_finite };
[[nodiscard]] std::string_view name(Termination termination);

struct LeastSquaresResult {
  Termination termination = Termination::no_descent;
  std::string message;       ///< Names the rule that stopped the search, in one sentence.
  Eigen::VectorXd x;         ///< The minimum.
  Eigen::VectorXd residual;  ///< r(x).
  Eigen::MatrixXd jacobian;  ///< dr/dx at x.
  double cost = 0.0;         ///< 1/2 |r|^2.
  int iterations = 0;
  int evaluations = 0;               ///< Evaluations of the residual, with or without the Jacobian.
  std::vector<bool> at_bound;        ///< For each parameter: the minimum is at a bound.
  std::vector<double> cost_history;  ///< Cost at the start and after each accepted step.
};

/// Minimizes C(x) = 1/2 |r(x)|^2 subject to lower <= x <= upper, from `start` (clipped to the
/// bounds). Throws InvalidInput if sizes disagree or r is not finite at the start. A search that
/// fails does not throw, but says so in `termination`. Same input, same result.
[[nodiscard]] LeastSquaresResult minimize(const LeastSquaresProblem& problem,
                                          const Eigen::VectorXd& start,
                                          const LeastSquaresOptions& options = {});

}  // namespace myoid::inline ground::math
