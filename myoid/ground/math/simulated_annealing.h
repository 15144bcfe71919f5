#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/math/direct_search.h"

namespace myoid::inline ground::math {

struct AnnealingOptions {
  std::uint64_t seed = 1;
  int max_evaluations = 200000;
  /// First temperature. 0: the standard deviation of the cost over 20 random points per parameter of the box.
  double first_temperature = 0.0;
  double cooling = 0.85;  ///< Ratio of successive temperatures.
  /// lambda above 0: the temperature instead falls by exp(-lambda temperature / spread of the costs
  /// at that temperature) (Huang, Romeo and Sangiovanni-Vincentelli 1986, lambda 0.7). It then
  /// falls as fast as the costs, however many powers of ten they span, but never below `cooling`
  /// squared per step, and cost_tolerance is a share of |best cost| alone.
  double spread_cooling = 0.0;
  int cycles = 20;       ///< Moves of each parameter between adjustments of the step.
  int adjustments = 10;  ///< Adjustments of the step per temperature.
  /// Largest step of each parameter, and the box about the start whose costs give the first
  /// temperature; bounds may then be infinite. Empty: the widths of the bounds.
  Eigen::VectorXd reach;
  /// The search ends when the ends of four successive temperatures agree with the best, to this share of |best cost| +
  /// first temperature.
  double cost_tolerance = 1e-8;
  Progress progress;
};

/// Minimizes a cost within its bounds by simulated annealing; bounds must be finite unless `reach` is given. Each
/// parameter has a step that keeps half of its moves accepted (Corana, Marchesi, Martini and Ridella 1987). A move
/// changes one parameter by a uniform step and is accepted with probability min(1, exp(-rise / temperature)); a move
/// outside the bounds is drawn again inside. After each temperature the search continues from the best point. The end
/// is near the global minimum to about sqrt(cost_tolerance) in x: polish it with another solver. Slower cooling and
/// more adjustments find it more often. Of 40 seeds on Rastrigin's function in 2, 4 and 6 parameters, 39, 10 and 5 find
/// it with the defaults (24 000 evaluations per parameter), and 40, 40 and 26 with cooling 0.95 and 40 adjustments (300
/// 000). Same seed, same result, on every machine with the same std::exp. Throws as nelder_mead does, or if a bound is
/// infinite and no reach given.
[[nodiscard]] DirectSearchResult simulated_annealing(const DirectSearchProblem& problem,
                                                     const Eigen::VectorXd& start,
                                                     const AnnealingOptions& options = {});

}  // namespace myoid::inline ground::math
