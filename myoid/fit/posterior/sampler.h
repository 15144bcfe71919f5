#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "myoid/fit/posterior/marginals.h"
#include "myoid/fit/posterior/mode.h"
#include "myoid/ground/core/progress.h"

namespace myoid::fit {

/// Draws of several chains, and how well the chains agree.
struct Sampled {
  Eigen::MatrixXd draws;  ///< One column each, chain after chain.
  double rhat = 1.0;      ///< Greatest split R-hat of an entry of x: 1 where all chains agree.
  double accepted = 1.0;  ///< Share of the proposals that were taken.
  /// Returns true if the draws represent the density.
  [[nodiscard]] bool trusted() const { return rhat < 1.1 && accepted > 0.4; }
};

/// Takes `count` draws from a density by Hamiltonian Monte Carlo (Duane et al. 1987; Neal 2011), in
/// the coordinates u of Laplace's approximation about a mode,
///
///   x = mode + R u,   R R' = covariance,    H(u, p) = -ln p(x) + 1/2 |p|^2,   p ~ N(0, 1),
///
/// in which a nearly normal density is nearly a sphere. A proposal follows H by leapfrog steps for about a quarter
/// turn, after which draws from a sphere are independent. Four chains begin at draws from the approximation. Each chain
/// tunes its step twice over 60 proposals, which are not kept, until 80 % of its proposals are taken. In between, seven
/// tenths of all chains' covariance and three tenths of Laplace's become the covariance. The draws do not depend on the
/// number of threads.
[[nodiscard]] Sampled sample_density(
    const LogDensity& density, const Mode& mode, Eigen::Index count, std::uint64_t seed, const Progress& progress);

}  // namespace myoid::fit
