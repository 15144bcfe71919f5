#pragma once

#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/page/workbench.h"

namespace myoid::results {

/// Adds the muscles of a fit to the workbench, so that the reader can move their optimal fiber
/// length, width and maximal force:
/// - the law's numbers in the order of fit::MuscleField; the literature's are the means
///   of the priors, which know the recorded effort, else the starting values;
/// - the sliders' ranges: half of the lesser of literature and estimate to 1.6 times the greater;
/// - spread and correlation of the logarithms after the recording (run::log_covariance);
/// - the draws of a fit that has them.
/// Precondition: the fit has values for each muscle.
void add_movable_muscles(const fit::IdentificationResult& fit,
                         const std::vector<fit::MuscleSetup>& muscles,
                         page::Workbench& workbench);

}  // namespace myoid::results
