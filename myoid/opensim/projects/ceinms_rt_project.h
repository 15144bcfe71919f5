#pragma once

#include "myoid/opensim/projects/project.h"
#include "myoid/opensim/projects/project_files.h"

namespace myoid::opensim {

/// Reads a project of CEINMS-RT from its calibration (<simulatedAnnealing>) or from a subject, which alone may be
/// there. Where the calibration does not name the files that are there, the names of the subjects tell which one is
/// calibrated ("uncalibrated", "calibrated"). Bounds are those of the program's objective function; if that is not
/// known, of each quantity the narrowest range of the program that holds all numbers. Each folder with emgFilt, ik or
/// id is a trial. Throws ReadError for a damaged file.
[[nodiscard]] Project read_ceinms_rt_project(const ProjectFolder& folder, const RootedFile& main);

}  // namespace myoid::opensim
