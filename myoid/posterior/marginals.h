#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/posterior/draws.h"
#include "myoid/posterior/mode.h"

namespace myoid::identification {

/// The density of one entry of x, unnormalized, in Laplace's standard deviations t from the mode:
/// ln p(t) is the cubic through values and slopes at -2, 0 and 2, and a parabola in the tails.
class Marginal {
 public:
  /// Where a search was at t = -2 or 2: ln p less that of the mode, and its slope in t.
  struct Side {
    double log_density = -2.0;
    double slope = 0.0;
  };
  static constexpr double kSide = 2.0;
  /// The normal distribution's sides are {-2, 2} and {-2, -2}.
  Marginal(const Side& below, const Side& above);

  [[nodiscard]] double log_density(double t) const;
  /// The t below which as much lies as below `normal` in the standard normal distribution.
  [[nodiscard]] double at(double normal) const;

 private:
  std::array<Side, 2> sides_;
  std::vector<double> share_;  ///< Of the distribution below the points of a grid of t.
};

/// Returns ln p(x) and fills the gradient.
using LogDensity = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

/// The marginal of every entry of x about a mode with covariance C. The other entries follow to
/// their expectation given x_j, mode + t C e_j / sd_j, and one step of Newton from there:
///
///   ln p(t) = f + 1/2 g' K g,   K = C - C e_j e_j' C / C_jj
///
/// f and g are the density's value and gradient. The change of the determinant of the other
/// entries' curvature along t is left out. A side where the density is not finite stays normal.
[[nodiscard]] std::vector<Marginal> marginals(const LogDensity& density,
                                              const Mode& mode,
                                              const Progress& progress);

/// Draws with these marginals and the dependence of the normal distribution with the mode's
/// covariance (a Gaussian copula), of equal weights.
[[nodiscard]] Draws draw_about(const Mode& mode,
                               const std::vector<Marginal>& marginals,
                               Eigen::Index count,
                               std::uint64_t seed);

}  // namespace myoid::identification
