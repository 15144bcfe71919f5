#pragma once

#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/math/least_squares.h"

namespace myoid::inline ground::math {

/// The end of one local search.
struct LocalMinimum {
  Termination termination = Termination::no_descent;
  Eigen::VectorXd x;
  /// +inf: the start is outside the domain.
  double cost = std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

/// Descends from `start`. Called from several threads at once.
using LocalSearch = std::function<LocalMinimum(const Eigen::VectorXd& start)>;

struct MultistartOptions {
  std::vector<Eigen::VectorXd> starts;  ///< At least one.
  Eigen::VectorXd lower, upper;         ///< The box of the starts; finite, one end per parameter.
  /// Two minima are one basin if no parameter differs by more than this share of the box's width.
  double x_tolerance = 1e-4;
  Progress progress;
};

struct Basin {
  Eigen::VectorXd x;  ///< Point of its lowest member.
  double cost = 0.0;
  Eigen::Index converged = 0;         ///< Number of members whose search converged.
  std::vector<Eigen::Index> members;  ///< Indices, increasing, of the starts that ended here.
};

struct MultistartResult {
  std::vector<LocalMinimum> minima;  ///< One per start, in the same order.
  std::vector<Basin> basins;         ///< In order of increasing cost: front() is the answer. Empty if all failed.
  std::vector<Eigen::Index> failed;  ///< Starts that reached no finite cost.
};

/// Runs local searches from all starts in parallel and gathers their ends into basins. The result does not depend on
/// the number of threads. Throws InvalidInput if there is no start or one has another size than the box, or if the box
/// is empty or not finite; Interrupted; and exceptions of `search`.
[[nodiscard]] MultistartResult multistart(const LocalSearch& search, const MultistartOptions& options);

}  // namespace myoid::inline ground::math
