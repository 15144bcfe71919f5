#pragma once

#include <optional>

#include "myoid/body/model/body_model.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns the model of a trial where it differs from the study's: the arm that the markers measure, with the held
/// mass, and with calibrated coordinates held. Throws InvalidInput if a held mass has no point of action, or as
/// `calibration_window`.
[[nodiscard]] std::optional<body::BodyModel> trial_model(const Study& study,
                                                         const body::BodyModel& model,
                                                         const TrialSpec& trial,
                                                         const TrialInput& input);

}  // namespace myoid::study
