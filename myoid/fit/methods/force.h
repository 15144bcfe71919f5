#pragma once

#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/fit/methods/cross_validation.h"

namespace myoid::fit {

struct ForceOptions {
  EstimatorOptions estimator;
  bool shared_forces = false;  ///< Computed by an optimizer: at best `prior_dominated`.
  bool detect_exact = false;   ///< Looks for an exact fit first (identify_exactly).
};

/// Fits every muscle alone, shortening and lengthening together, to its own force (measured, or from force sharing).
/// The density is that of method `torque` with one muscle and a moment arm of 1. Throws InvalidInput if the data have
/// no forces.
[[nodiscard]] IdentificationResult identify_force(const StudyData& data, const ForceOptions& options = {});

/// Predicts parts of the trials by the fits to the others, muscle by muscle: the fits of `identify_force` to measured
/// forces with noise. A fold names its muscle as its joint, and its scores are of forces [N].
[[nodiscard]] std::vector<Fold> cross_validate_force(const StudyData& data,
                                                     const EstimatorOptions& options,
                                                     const CrossValidationOptions& how);

/// Returns the study of one muscle that `identify_force` fits.
[[nodiscard]] StudyData force_study(const StudyData& data, std::size_t muscle);

}  // namespace myoid::fit
