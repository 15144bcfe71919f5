#pragma once

#include "myoid/identification/estimator.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Reports a solution of the estimator: estimates with intervals by every requested route, covariance, rank, collinear
/// sets, diagnoses and warnings. Leaves predictions and computing time to the caller.
[[nodiscard]] IdentificationResult report_estimates(const Estimator& estimator,
                                                    const Estimator::Solution& solution,
                                                    const StudyData& data);

}  // namespace myoid::identification
