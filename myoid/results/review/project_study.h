#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/opensim/projects/project.h"
#include "myoid/study/study.h"

namespace myoid::results {

/// The joints of a project, and its muscles that have EMG, as a study.
struct ProjectStudy {
  /// EMG of muscles that take several channels, or a channel by a weight: a column for each mixture.
  struct MixedEmg {
    std::filesystem::path file;
    TimeSeries emg;
  };
  study::Study study;
  std::vector<MixedEmg> mixed;  ///< The study names these files; they are still to be written.
  std::vector<Remark> remarks;
};

/// Returns the joints that a review judges: those whose torque the calibration fits and on which a muscle with EMG
/// acts, as far as the files tell; if there are none, all on which such a muscle acts.
[[nodiscard]] std::vector<std::string> reviewed_joints(const opensim::Project& project);

/// Returns the study of a project, for a study.toml in `folder`. Its trials are those with EMG, torques, and either
/// lengths with moment arms or a motion and the model. Muscles that act on the same of these joints and share their
/// channels are one: the model's muscles lumped by their maximal forces, or, without a model, muscles with one scale.
/// Starting values are those of the subject before its calibration. Trials of CEINMS are cut to the times that the
/// project states. Envelopes have an unknown gain, because the files do not tell by which contraction they were
/// normalized. Throws InvalidInput if no joint, trial or muscle is left, with the reason.
[[nodiscard]] ProjectStudy study_of_project(const opensim::Project& project,
                                            const std::vector<std::string>& joints,
                                            const std::filesystem::path& folder);

/// Returns the muscles of the project that a muscle of its study stands for.
[[nodiscard]] std::vector<std::string> muscles_of(const study::MuscleSpec& muscle);

}  // namespace myoid::results
