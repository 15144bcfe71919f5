#pragma once

namespace myoid::inline ground::math {

/// The map from a number without bounds to a number within bounds, as a share t of the way from the lower to the upper
/// one, 0 < t < 1:
///
///   t = w ln (1 + exp(y / w)) - w ln (1 + exp((y - 1) / w)),    y = (2 + x) / 4,    w = 1/20.
///
/// Between the bounds t is y but for exp(-y / w): the density of x is that of t, and its greatest value is at the same
/// place. (A logistic map pulls the mode to the middle: each bounded number has a term of its own, and many that share
/// an uncertainty pull together.) Within w of a bound t becomes an exponential of x.
struct Bounded {
  double share = 0.0;      ///< t
  double slope = 0.0;      ///< dt/dx
  double log_slope = 0.0;  ///< ln dt/dx
  double pull = 0.0;       ///< d ln(dt/dx) / dx
  double curvature = 0.0;  ///< -d^2 ln(dt/dx) / dx^2, positive
};

[[nodiscard]] Bounded bounded(double x);

/// Returns the x of a share t within the bounds.
[[nodiscard]] double unbounded(double share);

}  // namespace myoid::inline ground::math
