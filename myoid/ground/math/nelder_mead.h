#pragma once

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/math/direct_search.h"

namespace myoid::inline ground::math {

/// Minimizes a cost by the downhill simplex of Nelder and Mead (1965), with coefficients that depend on the dimension
/// (Gao and Han 2012). The first edges are a tenth of |x_j|, of 1 at zero. A simplex has shrunk to a point when no
/// coordinate spreads by more than 1e-9 of max(|x_j|, its first edge), or when all its costs agree to 1e-15 of the
/// lowest. A shrunken simplex alone proves nothing (McKinnon 1998): the search restarts there, up to ten times, until a
/// new simplex lowers the cost by less than 1e-10 of it. `converged`: a restart confirmed the point. Same input, same
/// result. Throws as CountedCost::at_start does; Interrupted.
[[nodiscard]] DirectSearchResult nelder_mead(const CostFunction& cost,
                                             const Eigen::VectorXd& start,
                                             int max_evaluations = 20000,
                                             const Progress& progress = {});

}  // namespace myoid::inline ground::math
