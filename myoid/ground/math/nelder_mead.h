#pragma once

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/math/direct_search.h"

namespace myoid::inline ground::math {

struct NelderMeadOptions {
  int max_evaluations = 20000;
  double first_edge = 0.1;  ///< Share of upper - lower; of |x_j| (or 1 at zero) without bounds.
  Progress progress;
};

/// Minimizes a cost within its bounds by the downhill simplex of Nelder and Mead (1965), with coefficients that depend
/// on the dimension (Gao and Han 2012). A simplex has shrunk to a point when no coordinate spreads by more than 1e-9 of
/// max(|x_j|, its first edge), or when all its costs agree to 1e-15 of the lowest. A shrunken simplex alone proves
/// nothing (McKinnon 1998): the search restarts there, up to ten times, until a new simplex lowers the cost by less
/// than 1e-10 of it. Points outside the bounds are moved onto them. The search begins at `start`, clipped. `converged`:
/// a restart confirmed the point. Same input, same result. Throws InvalidInput as CountedCost does, or if the start is
/// not finite or has no finite cost; Interrupted.
[[nodiscard]] DirectSearchResult nelder_mead(const DirectSearchProblem& problem,
                                             const Eigen::VectorXd& start,
                                             const NelderMeadOptions& options = {});

}  // namespace myoid::inline ground::math
