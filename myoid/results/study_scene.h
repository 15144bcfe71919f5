#pragma once

#include <filesystem>

#include "myoid/report/scene_page.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Where a run's page with its moving trials is, in its folder.
inline constexpr const char* kMotionPage = "motion.html";

/// The model in every trial of a run that has a motion, with its measured markers, the shared
/// forces and the activation by EMG of each muscle that the study names; no scene if none has one.
/// All trials together have at most `most_frames` frames.
[[nodiscard]] report::ScenePage study_scenes(const StudyResult& result, int most_frames = 6000);

/// True if `write_motion_page` writes one: there is a motion, and the program has a viewer.
[[nodiscard]] bool has_motion_page(const StudyResult& result);

/// Writes the page into the run's folder, or removes the page of an earlier run.
void write_motion_page(const StudyResult& result, const std::filesystem::path& folder);

}  // namespace myoid
