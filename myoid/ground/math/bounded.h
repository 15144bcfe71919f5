#pragma once

namespace myoid::inline ground::math {

/// The map of a number without bounds, x, to a share t of the way from a lower to an upper bound, 0 < t < 1:
///
///   gradual: t = 1 / (1 + exp(-x))
///   sharp:   t = w ln (1 + exp(y / w)) - w ln (1 + exp((y - 1) / w)),    y = (2 + x) / 4,    w = 1/20.
///
/// Both have the slope 1/4 in the middle. The density of x has the factor dt/dx. By `gradual` its mode is drawn to the
/// middle: of a number that nothing determines the mode is then the mean. Numbers that share one uncertainty are drawn
/// together, each by itself, and so beyond their mean. By `sharp` t is y between the bounds, and nothing is drawn.
enum class BoundShape { gradual, sharp };

/// A share and its derivatives by x.
struct Bounded {
  double share = 0.0;      ///< t
  double slope = 0.0;      ///< dt/dx
  double log_slope = 0.0;  ///< ln dt/dx
  double pull = 0.0;       ///< d ln(dt/dx) / dx
  double curvature = 0.0;  ///< -d^2 ln(dt/dx) / dx^2, positive
};

[[nodiscard]] Bounded bounded(double x, BoundShape shape);

/// Returns the x of a share t within the bounds.
[[nodiscard]] double unbounded(double share, BoundShape shape);

}  // namespace myoid::inline ground::math
