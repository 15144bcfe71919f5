#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/math/direct_search.h"

namespace myoid::inline ground::math {

struct AnnealingOptions {
  std::uint64_t seed = 1;
  int max_evaluations = 20000;
  /// Largest step of each parameter. The box about the start with these widths gives the first temperature: the
  /// standard deviation of the cost over 20 random points per parameter.
  Eigen::VectorXd reach;
  Progress progress;
};

/// Minimizes a cost by simulated annealing. Each parameter has a step that keeps half of its moves accepted (Corana,
/// Marchesi, Martini and Ridella 1987). A move changes one parameter by a uniform step and is accepted with probability
/// min(1, exp(-rise / temperature)). After 10 moves of each parameter the search continues from the best point, and the
/// temperature falls by exp(-0.7 temperature / spread of the costs at that temperature) (Huang, Romeo and
/// Sangiovanni-Vincentelli 1986), by 0.72 at most: as fast as the costs, however many powers of ten they span. The
/// search ends when the ends of four successive temperatures agree with the best to 1e-8 of its cost, near the minimum
/// to about 1e-4 in x: polish it with another solver. Same seed, same result, on every machine with the same std::exp.
/// Throws as CountedCost::at_start does, or if `reach` is not one finite width per parameter; Interrupted.
[[nodiscard]] DirectSearchResult simulated_annealing(const CostFunction& cost,
                                                     const Eigen::VectorXd& start,
                                                     const AnnealingOptions& options);

}  // namespace myoid::inline ground::math
