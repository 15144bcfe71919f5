#pragma once

#include <filesystem>

#include "myoid/report/scene_page.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Name of the page with the moving trials in the run's folder.
inline constexpr const char* kMotionPage = "motion.html";

/// Returns the model in every trial of a run that has a motion, with its measured markers, the
/// shared forces and the activation by EMG of each muscle that the study names; no scene if none
/// has one. All trials together have at most `most_frames` frames.
[[nodiscard]] report::ScenePage study_scenes(const StudyResult& result, int most_frames = 6000);

/// Returns true if there is a motion and the program has a viewer, so that `write_motion_page`
/// writes a page.
[[nodiscard]] bool has_motion_page(const StudyResult& result);

/// Writes the page into the run's folder, or removes the page of an earlier run.
void write_motion_page(const StudyResult& result, const std::filesystem::path& folder);

}  // namespace myoid
