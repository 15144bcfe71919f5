#pragma once

#include <filesystem>
#include <vector>

#include "myoid/results/exports/exported_project.h"

namespace myoid::results {

/// Writes each project in the form of its program, with paths relative to the folder: ceinms_calibrated.xml and
/// ceinms_uncalibrated.xml, ceinms_rt_calibrated.xml and ceinms_rt_uncalibrated.xml, nmsm.osimx. The second of a pair
/// holds the numbers from which the fit began.
void write_exports(const std::vector<ExportedProject>& exported, const std::filesystem::path& folder);

}  // namespace myoid::results
