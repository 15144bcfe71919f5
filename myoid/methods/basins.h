#pragma once

#include "myoid/core/progress.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"
#include "myoid/math/multistart.h"
#include "myoid/methods/start_box.h"

namespace myoid::identification {

/// Searches from the given start and Sobol points of the box, in parallel. Two ends are one basin if no unknown differs
/// by more than 0.04 spreads. The cost has no weights: its variance over `samples` residuals scales it to chi-square.
/// Throws Interrupted.
[[nodiscard]] BasinTable find_basins(const math::LocalSearch& search,
                                     const StartBox& box,
                                     int starts,
                                     Eigen::Index samples,
                                     const Progress& progress = {});

/// Returns the minima of the source paper's published criterion for one muscle in one branch.
/// Empty if every number is held or the case is not fitted (PaperCase::obstacle).
[[nodiscard]] BasinTable find_paper_basins(const StudyData& data, std::size_t muscle, bool shortening, int starts);

}  // namespace myoid::identification
