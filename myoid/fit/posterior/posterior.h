#pragma once

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Identifies the unknowns: estimates, intervals and verdicts from one posterior (density.h) of the
/// torques of all joints.
///
/// The interval "of the person" comes from draws of the posterior (exploration.h), over all modes.
/// Estimates, IdentificationResult::solution and ::covariance are those of the heaviest mode. The
/// second reading, ParameterEstimate::given_estimate with its interval, is that of a posterior in which moment arms,
/// tendons, the torque's scale, effort and cross-talk are exact; without EstimatorOptions::marginals (a fold's
/// fit) it is the first without a width. IdentificationResult::trials is left empty. Throws InvalidInput without
/// priors.
[[nodiscard]] IdentificationResult identify_by_posterior(const StudyData& data, const EstimatorOptions& options);

}  // namespace myoid::fit
