#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/posterior/mode.h"
#include "myoid/ground/core/progress.h"

namespace myoid::fit {

/// The density of one entry of x, unnormalized, in Laplace's standard deviations t from the mode: ln p(t) is the cubic
/// through values and slopes at -2, 0 and 2, a parabola in the tails, and `drift` t.
class Marginal {
 public:
  /// State of the search at t = -2 or 2: ln p less that of the mode, and its slope in t.
  struct Side {
    double log_density = -2.0;
    double slope = 0.0;
  };
  static constexpr double kSide = 2.0;
  /// Builds ln p(t) from both sides. A normal distribution has the sides {-2, 2} and {-2, -2}.
  Marginal(const Side& below, const Side& above, double drift = 0.0);

  [[nodiscard]] double log_density(double t) const;
  /// Returns the t at which the distribution reaches the share that a standard normal one has at `normal`.
  [[nodiscard]] double at(double normal) const;

 private:
  std::array<Side, 2> sides_;
  double drift_ = 0.0;
  std::vector<double> share_;  ///< Share of the distribution below each point of a grid of t.
};

/// Returns ln p(x) and fills the gradient.
using LogDensity = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

/// Returns the marginal of every entry of x about a mode with covariance C. Those of the first
/// `followed` entries follow the density; the rest stay normal. The other entries move to their
/// expectation given x_j, mode + t C e_j / sd_j, and from there by one step of Newton:
///
///   ln p(t) = f + 1/2 g' K g + c t,   K = C - r r',   r = C e_j / sd_j
///
/// f and g are the density's value and gradient. c t is the change of the other entries' volume,
/// -1/2 ln |curvature| (Rue, Martino and Chopin, J R Stat Soc B 71:319, 2009, their simplified
/// Laplace approximation), to the first order by the third derivatives T of ln p,
///
///   c = 1/2 sum_kl T(r)_kl K_kl = 1/2 (r' w - T(r, r, r)),   w_i = sum_kl T_ikl C_kl.
///
/// Without c, F_max lies a standard deviation too high where many numbers err with it. A side where
/// the density is not finite stays normal.
[[nodiscard]] std::vector<Marginal> marginals(const LogDensity& density,
                                              const Mode& mode,
                                              Eigen::Index followed,
                                              const Progress& progress);

/// Draws points, one column each, with these marginals and, as a Gaussian copula, the dependence of
/// the normal distribution with the mode's covariance.
[[nodiscard]] Eigen::MatrixXd draw_about(const Mode& mode,
                                         const std::vector<Marginal>& marginals,
                                         Eigen::Index count,
                                         std::uint64_t seed);

}  // namespace myoid::fit
