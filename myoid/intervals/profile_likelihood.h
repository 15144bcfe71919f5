#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/normal.h"
#include "myoid/identification/estimator.h"
#include "myoid/intervals/uncertainty.h"

namespace myoid::identification {

/// A cost within bounds, about its minimum.
struct ProfileProblem {
  /// Returns C(z) and fills its gradient.
  std::function<double(const Eigen::VectorXd& z, Eigen::VectorXd& gradient)> cost;
  Eigen::VectorXd lower, upper;
  Eigen::VectorXd minimum;
  double least = 0.0;         ///< C there ...
  Eigen::VectorXd gradient;   ///< ... its gradient, not zero for what leans on a bound ...
  Eigen::MatrixXd curvature;  ///< ... and its curvature, about: J'J will do.
};

/// Distance from the minimum of variable j to the side where sqrt(2 (C - C_min)) reaches `goal`
/// when all other variables adapt, to about 1 %; empty where a bound of j comes first: the profile
/// is open.
///
/// The others are brought to their constrained minimum by quasi-Newton steps (BFGS, bounds by
/// projection) that begin with `curvature` and end when the next would lower C by less than a
/// twentieth of its rise to the goal; that fall, which the model knows to a third or better, is
/// taken as if it had been made. The root is sought
/// on v(t) = sqrt(2 (C - C_min)), which is nearly proportional to t: its slope is dC/dz_j / v,
/// because the others are at their minimum, and the parabola through the origin, v and v' leads to
/// the root in one or two steps.
[[nodiscard]] std::optional<double> profile_distance(const ProfileProblem& problem,
                                                     Eigen::Index j,
                                                     bool above,
                                                     double goal = kNormal95);

/// The 95 % intervals of all variables by profile likelihood, in parallel; weights are those of the
/// solution.
///
/// Residuals are correlated, so that C is no likelihood but a composite one: 2 (C - C_min) of a
/// parameter is as chi-squared times the ratio of its `variance`, which the sandwich knows, to the
/// one that the curvature of C would give it (Rotnitzky & Jewell 1990; Pace, Salvan & Sartori
/// 2011). Where either is not to be had the ratio is 1.
[[nodiscard]] std::vector<Interval> profile(const Estimator& estimator,
                                            const Estimator::Solution& solution,
                                            const Eigen::VectorXd& variance);

}  // namespace myoid::identification
