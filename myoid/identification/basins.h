#pragma once

#include "myoid/core/progress.h"
#include "myoid/identification/estimator.h"
#include "myoid/identification/result.h"
#include "myoid/identification/start_box.h"
#include "myoid/math/multistart.h"

namespace myoid::identification {

/// Searches from the given start and Sobol points of the box, in parallel. Two ends are one basin
/// if no unknown differs by more than 0.04 spreads. `plain_samples` is the number of residuals of a
/// cost that does not weight them, which their own variance then turns into chi-square; 0: it does.
/// Throws Interrupted.
[[nodiscard]] BasinTable find_basins(const math::LocalSearch& search,
                                     const StartBox& box,
                                     int starts,
                                     Eigen::Index plain_samples = 0,
                                     const Progress& progress = {});

/// Of the estimator's own search, with these weights.
[[nodiscard]] BasinTable find_basins(const Estimator& estimator,
                                     const Weighting& weighting,
                                     int starts);

/// Of the source paper's plain Gauss-Newton steps on one muscle in one branch; no basins where all
/// is held or it is not fitted (PaperCase::obstacle).
[[nodiscard]] BasinTable find_paper_basins(const StudyData& data,
                                           std::size_t muscle,
                                           bool shortening,
                                           int starts);

}  // namespace myoid::identification
