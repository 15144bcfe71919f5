#pragma once

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Identifies the unknowns: estimates, intervals and verdicts from one posterior (density.h) of the
/// torques of all joints.
///
/// The interval "of the person" comes from draws of the posterior (exploration.h). The route
/// "geometry_and_sensors_exact" gives the interval of a posterior in which moment arms, tendons,
/// the torque's scale, cross-talk and drift are exact. IdentificationResult::trials is left empty.
/// Throws InvalidInput without priors.
[[nodiscard]] IdentificationResult identify_by_posterior(const StudyData& data,
                                                         const EstimatorOptions& options);

}  // namespace myoid::identification
