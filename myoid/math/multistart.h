#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/math/least_squares.h"

namespace myoid::math {

/// Where one local search ended.
struct LocalMinimum {
  Termination termination = Termination::no_descent;
  Eigen::VectorXd x;
  double cost = std::numeric_limits<double>::infinity();  ///< +inf: the start is not in the domain.
  int evaluations = 0;
};

/// A descent from `start`; `index` numbers the starts (for its own random stream). Called from
/// several threads at once.
using LocalSearch = std::function<LocalMinimum(const Eigen::VectorXd& start, Eigen::Index index)>;

struct MultistartOptions {
  Eigen::Index starts = 32;  ///< Sobol points in the box, besides `given`.
  Eigen::VectorXd lower;     ///< Of the box of starts; finite, one per parameter.
  Eigen::VectorXd upper;
  std::vector<bool> logarithmic;       ///< Empty, or per parameter: spread evenly in its logarithm.
  std::vector<Eigen::VectorXd> given;  ///< Starts tried first, in this order.
  std::optional<std::uint64_t> scramble_seed;  ///< See SobolOptions; empty: the plain sequence.
  /// Two minima are one basin if no parameter differs by more than this share of the box's width.
  double x_tolerance = 1e-4;
  /// A basin rivals the best if its cost is at most this much higher. 2 is a difference of 4 in
  /// chi-square for residuals of unit variance.
  double rival_cost = 2.0;
  Progress progress;
};

struct Basin {
  Eigen::VectorXd x;  ///< Of its lowest member.
  double cost = 0.0;
  bool rival = false;                 ///< Its cost is within `rival_cost` of the best; the best is.
  Eigen::Index converged = 0;         ///< Members whose search converged.
  std::vector<Eigen::Index> members;  ///< Indices of starts that ended here, rising.
};

struct MultistartResult {
  std::vector<Eigen::VectorXd> starts;
  std::vector<LocalMinimum> minima;  ///< One per start, in the same order.
  std::vector<Basin> basins;         ///< By rising cost: front() is the answer. Empty: all failed.
  std::vector<Eigen::Index> failed;  ///< Starts that ended at no finite cost.
  int evaluations = 0;               ///< Of all searches together.
};

/// Local searches from `given` and from Sobol points of the box, in parallel, their ends gathered
/// into basins. The result does not depend on the number of threads. Throws InvalidInput if the
/// box is empty, not finite, or not positive where logarithmic, or if a given start has another
/// size; Interrupted; and what `search` throws.
[[nodiscard]] MultistartResult multistart(const LocalSearch& search,
                                          const MultistartOptions& options);

/// The same with minimize(problem, start, search) as the local search. A start at which the
/// residual is not finite is a failed one. `problem.evaluate` must be safe to call from threads.
[[nodiscard]] MultistartResult multistart(const LeastSquaresProblem& problem,
                                          const LeastSquaresOptions& search,
                                          const MultistartOptions& options);

}  // namespace myoid::math
