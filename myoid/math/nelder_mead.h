#pragma once

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/math/direct_search.h"

namespace myoid::math {

struct NelderMeadOptions {
  int max_evaluations = 20000;
  /// A simplex has shrunk to a point when no coordinate spreads by more than this share of
  /// max(|x_j|, its first edge), or when all its costs agree to `cost_tolerance` of the lowest.
  double step_tolerance = 1e-9;
  double cost_tolerance = 1e-15;
  double first_edge = 0.1;  ///< Share of upper - lower; of |x_j| (or 1 at zero) without bounds.
  int max_restarts = 10;    ///< New simplices after the first; 0 accepts the first.
  /// A restart that lowers the cost by less than this share confirms the point.
  double restart_tolerance = 1e-10;
  bool adaptive = true;  ///< Coefficients that depend on the dimension (Gao and Han 2012).
  Progress progress;
};

/// Minimizes a cost within its bounds by the downhill simplex of Nelder and Mead (1965). A shrunken simplex alone
/// proves nothing (McKinnon 1998): the search restarts there until a new simplex finds nothing lower. Points outside
/// the bounds are moved onto them. The search begins at `start`, clipped. `converged`: a restart confirmed the point;
/// with max_restarts = 0, the simplex shrank. Same input, same result. Throws InvalidInput as CountedCost does, or if
/// the start is not finite or has no finite cost; Interrupted.
[[nodiscard]] DirectSearchResult nelder_mead(const DirectSearchProblem& problem,
                                             const Eigen::VectorXd& start,
                                             const NelderMeadOptions& options = {});

}  // namespace myoid::math
