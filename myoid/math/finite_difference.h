#pragma once

#include <functional>

#include <Eigen/Core>

namespace myoid::math {

using ScalarFunction = std::function<double(const Eigen::VectorXd& x)>;
using VectorFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;

struct DifferenceOptions {
  /// First step: this times max(|x_j|, scale_j). Each later one is half of it.
  double first_step = 0.02;
  Eigen::VectorXd scale;  ///< Size of a parameter near zero; empty: 1 for each.
  int refinements = 8;    ///< Halvings; each asks for two evaluations per parameter.
  Eigen::VectorXd lower;  ///< Empty, or one per parameter: no evaluation beyond.
  Eigen::VectorXd upper;
};

/// Derivatives with what they may be off by.
struct GradientEstimate {
  Eigen::VectorXd value;
  Eigen::VectorXd error;  ///< Estimated absolute error per entry; +inf where none was found.
  int evaluations = 0;
};

struct JacobianEstimate {
  Eigen::MatrixXd value;  ///< m x n.
  Eigen::MatrixXd error;  ///< Estimated absolute error per entry; +inf where none was found.
  int evaluations = 0;
};

/// df/dx by central differences over halved steps, extrapolated to step zero (Richardson; Ridders
/// 1982): of all entries of the extrapolation table the one that changed least, and that change,
/// plus the noise of f that the shortest steps show over the step, as its error. Where a bound is
/// nearer than the step, the step is cut to it; nearer than 1e-6 of the step, differences to the
/// free side only (second order, extrapolated likewise). A step to where f is not finite is passed
/// over. A kink exactly at x looks smooth to central differences. Throws InvalidInput if x is not
/// finite or outside the bounds, sizes disagree, or options are not positive.
[[nodiscard]] GradientEstimate gradient_by_differences(const ScalarFunction& f,
                                                       const Eigen::VectorXd& x,
                                                       const DifferenceOptions& options = {});

/// dr/dx of a vector function, entry by entry as above; all rows share the evaluations. Throws
/// also if the function changes its size.
[[nodiscard]] JacobianEstimate jacobian_by_differences(const VectorFunction& r,
                                                       const Eigen::VectorXd& x,
                                                       const DifferenceOptions& options = {});

/// Largest |analytic - differences| over (largest entry of the column + 10 times the estimated
/// error): below about 1e-8 for a right Jacobian of a smooth function, about 2 for a wrong sign.
/// Entries without an estimate are left out; +inf if an analytic one is not finite. Throws
/// InvalidInput if sizes disagree.
[[nodiscard]] double jacobian_discrepancy(const Eigen::MatrixXd& analytic,
                                          const JacobianEstimate& differences);

}  // namespace myoid::math
