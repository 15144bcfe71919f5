#pragma once

#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"
#include "myoid/report/workbench.h"

namespace myoid {

/// Adds the muscles of a fit to the workbench, so that the reader can move their optimal fiber
/// length, width and maximal force:
/// - the law's numbers in the order of identification::MuscleField; the literature's are the means
///   of the priors, which know the recorded effort, else the starting values;
/// - the sliders' ranges: half of the lesser of literature and estimate to 1.6 times the greater;
/// - spread and correlation of the logarithms after the recording (identification::log_covariance);
/// - the draws of a fit that has them.
/// Precondition: the fit has values for each muscle.
void add_movable_muscles(const identification::IdentificationResult& fit,
                         const std::vector<identification::MuscleSetup>& muscles,
                         report::Workbench& workbench);

}  // namespace myoid
