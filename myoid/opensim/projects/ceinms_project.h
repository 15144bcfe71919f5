#pragma once

#include <filesystem>

#include "myoid/opensim/projects/project.h"
#include "myoid/opensim/projects/project_files.h"

namespace myoid::opensim {

/// Reads a project of CEINMS 0.9 to 0.21 from the set-up of its calibration (<ceinmsCalibration>), of a run (<ceinms>),
/// or from a subject. Other trials of the folder (<inputData>) are listed too. Throws ReadError for a file that is
/// damaged, and for a subject or a calibration that is named and missing.
[[nodiscard]] Project read_ceinms_project(const ProjectFolder& folder, const RootedFile& main);

}  // namespace myoid::opensim
