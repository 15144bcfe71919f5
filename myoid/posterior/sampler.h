#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/posterior/draws.h"
#include "myoid/posterior/marginals.h"
#include "myoid/posterior/mode.h"

namespace myoid::identification {

/// Draws of chains, and how well they agree.
struct Sampled {
  Draws draws;            ///< Of equal weights, chain after chain.
  double rhat = 1.0;      ///< Greatest split R-hat of an entry of x: 1 where all chains agree.
  double accepted = 1.0;  ///< Share of the proposals that were taken.
  /// The draws stand for the density.
  [[nodiscard]] bool trusted() const { return rhat < 1.1 && accepted > 0.4; }
};

/// `count` draws from a density by Hamiltonian Monte Carlo (Duane et al. 1987; Neal 2011), in the
/// coordinates u of Laplace's approximation about a mode,
///
///   x = mode + R u,   R R' = covariance,    H(u, p) = -ln p(x) + 1/2 |p|^2,   p ~ N(0, 1),
///
/// where a density that is nearly normal is nearly a sphere. A proposal follows H by leapfrog
/// steps for about a quarter turn, after which draws from a sphere are independent. Four chains
/// begin at draws from the approximation. Twice in 60 proposals, which are not kept, each finds the
/// step by which 80 % of its proposals are taken; in between, the covariance becomes that of all
/// chains, with three tenths of Laplace's. The same for every number of threads.
[[nodiscard]] Sampled sample_density(const LogDensity& density,
                                     const Mode& mode,
                                     Eigen::Index count,
                                     std::uint64_t seed,
                                     const Progress& progress);

}  // namespace myoid::identification
