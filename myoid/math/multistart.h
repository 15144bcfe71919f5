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

/// The end of one local search.
struct LocalMinimum {
  Termination termination = Termination::no_descent;
  Eigen::VectorXd x;
  /// +inf: the start is outside the domain.
  double cost = std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

/// Descends from `start`; `index` numbers the starts, for a random stream of its own. Called from
/// several threads at once.
using LocalSearch = std::function<LocalMinimum(const Eigen::VectorXd& start, Eigen::Index index)>;

struct MultistartOptions {
  Eigen::Index starts = 32;  ///< Number of Sobol points in the box, besides `given`.
  Eigen::VectorXd lower;     ///< Bounds of the starts; finite, one per parameter.
  Eigen::VectorXd upper;
  std::vector<bool> logarithmic;               ///< Empty, or per parameter: starts are spread evenly in its logarithm.
  std::vector<Eigen::VectorXd> given;          ///< Starts tried first, in this order.
  std::optional<std::uint64_t> scramble_seed;  ///< As in SobolOptions; empty: the plain sequence.
  /// Two minima are one basin if no parameter differs by more than this share of the box's width.
  double x_tolerance = 1e-4;
  /// A basin rivals the best if its cost is at most this much higher. 2 is a difference of 4 in
  /// chi-square for residuals of unit variance.
  double rival_cost = 2.0;
  Progress progress;
};

struct Basin {
  Eigen::VectorXd x;  ///< Point of its lowest member.
  double cost = 0.0;
  bool rival = false;                 ///< Its cost is within `rival_cost` of the best; true for the best.
  Eigen::Index converged = 0;         ///< Number of members whose search converged.
  std::vector<Eigen::Index> members;  ///< Indices, increasing, of the starts that ended here.
};

struct MultistartResult {
  std::vector<Eigen::VectorXd> starts;
  std::vector<LocalMinimum> minima;  ///< One per start, in the same order.
  std::vector<Basin> basins;         ///< In order of increasing cost: front() is the answer. Empty if all failed.
  std::vector<Eigen::Index> failed;  ///< Starts that reached no finite cost.
  int evaluations = 0;               ///< Over all searches.
};

/// Runs local searches from `given` and from Sobol points of the box in parallel and gathers their ends into basins.
/// The result does not depend on the number of threads. Throws InvalidInput if the box is empty, not finite, or not
/// positive where logarithmic, or if a given start has another size; Interrupted; and exceptions of `search`.
[[nodiscard]] MultistartResult multistart(const LocalSearch& search, const MultistartOptions& options);

/// Runs `multistart` with minimize(problem, start, search) as the local search. A start at which the residual is not
/// finite counts as failed. `problem.evaluate` must be safe to call from several threads.
[[nodiscard]] MultistartResult multistart(const LeastSquaresProblem& problem,
                                          const LeastSquaresOptions& search,
                                          const MultistartOptions& options);

}  // namespace myoid::math
