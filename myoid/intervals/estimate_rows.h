#pragma once

#include <vector>

#include "myoid/identification/estimator.h"
#include "myoid/intervals/reported_interval.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Returns the rows of parameters.csv of one solution with their intervals and verdicts: one row
/// for each unknown and owner, and one for each product V_sh V_shl that follows from a slope ratio.
/// `fit` holds the covariance, the values and the distances from the priors of the same solution.
[[nodiscard]] std::vector<ParameterEstimate> estimate_rows(const Estimator& estimator,
                                                           const Estimator::Solution& solution,
                                                           const StudyData& data,
                                                           const Intervals& intervals,
                                                           const IdentificationResult& fit);

}  // namespace myoid::identification
