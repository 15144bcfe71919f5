#pragma once

#include "myoid/model/body_model.h"
#include "myoid/pipeline/study.h"
#include "myoid/pipeline/trial_input.h"
#include "myoid/recording/marker_series.h"

namespace myoid::pipeline {

/// The markers of a trial from its file: under the model's names (renamed as the study says, or
/// where they differ in their writing alone), y up, cut to the trial's times, and mended as the
/// study allows. Notes, warnings and the faults found before the mending go to `input`. Throws
/// ReadError for fewer than 10 frames and as `check_clock` and `check_cutoff`.
[[nodiscard]] recording::MarkerSeries read_trial_markers(const Study& study,
                                                         const TrialSpec& trial,
                                                         const model::BodyModel& model,
                                                         TrialInput& input);

}  // namespace myoid::pipeline
