#pragma once

#include "myoid/page/scene_page.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Returns the model in every trial of a run with a motion, with its measured markers, the shared forces and the
/// activation by EMG of each muscle that the study names; no scene if no trial has a motion. All trials together have
/// at most `most_frames` frames. The scenes are in the study's order.
[[nodiscard]] page::ScenePage study_scenes(const run::StudyResult& result, int most_frames = 6000);

}  // namespace myoid::results
