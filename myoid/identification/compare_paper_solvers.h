#pragma once

#include "myoid/identification/compare_solvers.h"
#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// The four solvers on the problem that the source paper solves: 1/2 sum (F_t - F_m(x))^2 of one
/// muscle in one branch (paper_case.h), without weights, priors or bounds. Gauss-Newton is that of
/// `identify_paper`; annealing needs a box, that of the starts. Costs are in N^2. No runs where the
/// branch has fewer samples than unknowns, or all is held.
[[nodiscard]] SolverComparison compare_paper_solvers(const StudyData& data,
                                                     std::size_t muscle,
                                                     bool shortening,
                                                     const CompareOptions& options = {});

}  // namespace myoid::identification
