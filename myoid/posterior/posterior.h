#pragma once

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Estimates, intervals and verdicts from one posterior (density.h) of the torques of all joints.
///
/// The interval "of the person" is that of draws from the posterior (exploration.h). Beside it, as
/// the route "geometry_and_sensors_exact", stands the interval of a posterior in which moment arms,
/// tendons, the scale of the torque, cross-talk and drift are exact. IdentificationResult::trials
/// is left empty. Throws InvalidInput without priors.
[[nodiscard]] IdentificationResult identify_by_posterior(const StudyData& data,
                                                         const EstimatorOptions& options);

}  // namespace myoid::identification
