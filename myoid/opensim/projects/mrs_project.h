#pragma once

#include <filesystem>

#include "myoid/opensim/projects/project.h"
#include "myoid/opensim/projects/project_files.h"

namespace myoid::opensim {

/// Returns true for a script that calls the muscle redundancy solver: it sets Misc.IKfile and calls
/// solveMuscleRedundancy or MuscleTendonEstimator.
[[nodiscard]] bool is_mrs_script(const std::filesystem::path& path);

/// Reads what a script of the muscle redundancy solver tells without being run: files of the trials, their times,
/// joints, muscles, the muscles of EMG channels, the numbers that are estimated with their bounds and couplings. What
/// the script computes is named in a remark with its line. Where the channels of the muscles are computed or not told,
/// a table muscles.csv beside the script, with columns `muscle` and `emg`, tells them. Its results are files of MATLAB,
/// which are not read: the project is not calibrated, and the muscles have the numbers of the model. Throws ReadError
/// for a model or a table that is damaged.
[[nodiscard]] Project read_mrs_project(const ProjectFolder& folder, const std::filesystem::path& script);

}  // namespace myoid::opensim
