#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/normal.h"
#include "myoid/identification/estimator.h"
#include "myoid/intervals/uncertainty.h"

namespace myoid::identification {

/// A cost within bounds, with its values at the minimum.
struct ProfileProblem {
  /// Returns C(z) and fills its gradient.
  std::function<double(const Eigen::VectorXd& z, Eigen::VectorXd& gradient)> cost;
  Eigen::VectorXd lower, upper;
  Eigen::VectorXd minimum;
  double least = 0.0;         ///< C at the minimum.
  Eigen::VectorXd gradient;   ///< Gradient at the minimum; not zero for variables on a bound.
  Eigen::MatrixXd curvature;  ///< Approximate curvature at the minimum, for example J'J.
};

/// Returns the distance from the minimum of variable j to the side at which sqrt(2 (C - C_min)) reaches `goal` while
/// all other variables adapt, to about 1 %. Empty if a bound of j comes first: the profile is open.
///
/// Quasi-Newton steps (BFGS, bounds by projection) bring the others to their constrained minimum. They begin with
/// `curvature` and end when the next step would lower C by less than a twentieth of its rise to the goal. The model
/// predicts this last fall to a third or better, and C is taken as if the step had been made. The root is sought on
/// v(t) = sqrt(2 (C - C_min)), which is nearly proportional to t. Its slope is dC/dz_j / v, because the others are at
/// their minimum. The parabola through the origin, v and v' reaches the root in one or two steps.
[[nodiscard]] std::optional<double> profile_distance(const ProfileProblem& problem,
                                                     Eigen::Index j,
                                                     bool above,
                                                     double goal = kNormal95);

/// Returns the 95 % intervals of all variables by profile likelihood, in parallel, with the solution's weights.
///
/// Residuals are correlated, so C is a composite likelihood: 2 (C - C_min) of a parameter is distributed as chi-squared
/// times the ratio of its `variance` by the sandwich to its variance by the curvature of C (Rotnitzky & Jewell 1990;
/// Pace, Salvan & Sartori 2011). If either variance is missing the ratio is 1.
[[nodiscard]] std::vector<Interval> profile(const Estimator& estimator,
                                            const Estimator::Solution& solution,
                                            const Eigen::VectorXd& variance);

}  // namespace myoid::identification
