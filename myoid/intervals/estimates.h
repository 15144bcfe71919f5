#pragma once

#include <string_view>

#include "myoid/identification/estimator.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// The beginning of the warning of a fit whose R2 is below VerdictRules::least_r2.
inline constexpr std::string_view kExplainsLittle = "the fit explains little of the fitted samples";

/// Reports a solution of the estimator: estimates with intervals by every requested route, covariance, rank, collinear
/// sets, diagnoses and warnings. Leaves predictions and computing time to the caller.
[[nodiscard]] IdentificationResult report_estimates(const Estimator& estimator,
                                                    const Estimator::Solution& solution,
                                                    const StudyData& data);

}  // namespace myoid::identification
