#pragma once

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

struct ForceOptions {
  EstimatorOptions estimator;
  bool shared_forces = false;  ///< The forces are an optimizer's: no verdict is then better than
                               ///< `weak`.
  bool detect_exact = false;   ///< As identify_torque_or_exact.
  std::vector<std::string> speed_may_be_free;  ///< Likewise.
};

/// Every muscle alone, shortening and lengthening at once, against its own force (measured, or from
/// force sharing): the estimator of method `torque` with one muscle and a moment arm of 1, so with
/// bounds, priors, an EMG delay, weights and the same intervals. Throws InvalidInput if the data
/// have no forces.
[[nodiscard]] IdentificationResult identify_force(const StudyData& data,
                                                  const ForceOptions& options = {});

/// Its fit of one muscle, of the study that `force_study` makes.
[[nodiscard]] IdentificationResult identify_muscle_force(const StudyData& one_muscle,
                                                         const ForceOptions& options = {});

/// The study of one muscle that `identify_force` fits.
[[nodiscard]] StudyData force_study(const StudyData& data, std::size_t muscle);

}  // namespace myoid::identification
