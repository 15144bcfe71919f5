#pragma once

#include "myoid/report/scene_page.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Returns the model in every trial of a run with a motion, with its measured markers, the shared forces and the
/// activation by EMG of each muscle that the study names; no scene if no trial has a motion. All trials together have
/// at most `most_frames` frames. The scenes are in the study's order.
[[nodiscard]] report::ScenePage study_scenes(const StudyResult& result, int most_frames = 6000);

}  // namespace myoid
