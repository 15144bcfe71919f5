#pragma once

#include "myoid/files/marker_series.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Reads the markers of a trial: under the model's names (renamed as the study states, or if their spelling alone
/// differs), y up, cut to the trial's times, and mended as the study allows. Notes, warnings and the faults before
/// mending go to `input`. Throws ReadError for fewer than 10 frames and as `check_clock` and `check_cutoff`.
[[nodiscard]] recording::MarkerSeries read_trial_markers(const Study& study,
                                                         const TrialSpec& trial,
                                                         const model::BodyModel& model,
                                                         TrialInput& input);

/// Returns the markers in the window of a calibration. Throws InvalidInput for fewer than two frames.
[[nodiscard]] recording::MarkerSeries calibration_window(const CalibrationSpec& spec,
                                                         const recording::MarkerSeries& markers);

}  // namespace myoid
