#pragma once

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

struct ForceOptions {
  EstimatorOptions estimator;
  bool shared_forces = false;                  ///< Computed by an optimizer: at best `weak`.
  bool detect_exact = false;                   ///< As in identify_torque_or_exact.
  std::vector<std::string> speed_may_be_free;  ///< As in identify_torque_or_exact.
};

/// Fits every muscle alone, shortening and lengthening together, to its own force (measured, or from force sharing).
/// The estimator is that of method `torque` with one muscle and a moment arm of 1, by the options of `of_one_force`.
/// Throws InvalidInput if the data have no forces.
[[nodiscard]] IdentificationResult identify_force(const StudyData& data, const ForceOptions& options = {});

/// Returns the options of one muscle's fit. A force has no moment arm that could be wrong, and the electrode is the
/// muscle's own: both are exact. All muscles of one person follow their EMG by the same law, which is not chosen.
[[nodiscard]] EstimatorOptions of_one_force(EstimatorOptions options, bool shared_forces = false);

/// Fits one muscle of the study that `force_study` makes.
[[nodiscard]] IdentificationResult identify_muscle_force(const StudyData& one_muscle, const ForceOptions& options = {});

/// Returns the study of one muscle that `identify_force` fits.
[[nodiscard]] StudyData force_study(const StudyData& data, std::size_t muscle);

}  // namespace myoid::identification
