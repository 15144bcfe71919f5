#pragma once

#include "myoid/opensim/projects/project.h"
#include "myoid/opensim/projects/project_files.h"

namespace myoid::opensim {

/// Reads a project of the NMSM Pipeline from the settings of its muscle-tendon personalization or from an .osimx file,
/// which alone may be there. Stored delays are ten times, time constants a hundred times their value in seconds. Which
/// channel drives which muscle, and the lengths before the calibration, are in the model. Throws ReadError for a
/// damaged file, and for settings without a model.
[[nodiscard]] Project read_nmsm_project(const ProjectFolder& folder, const RootedFile& main);

}  // namespace myoid::opensim
