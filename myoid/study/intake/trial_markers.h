#pragma once

#include "myoid/body/model/body_model.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Reads the markers of a trial: under the model's names (renamed as the study states, or if their spelling alone
/// differs), y up, cut to the trial's times, and mended as the study allows. Notes, warnings and the faults before
/// mending go to `input`. Throws ReadError for fewer than 10 frames and as `check_clock` and `check_cutoff`.
[[nodiscard]] MarkerSeries read_trial_markers(const Study& study,
                                              const TrialSpec& trial,
                                              const body::BodyModel& model,
                                              TrialInput& input);

/// Returns the markers in the window of a calibration. Throws InvalidInput for fewer than two frames.
[[nodiscard]] MarkerSeries calibration_window(const CalibrationSpec& spec, const MarkerSeries& markers);

}  // namespace myoid::study
