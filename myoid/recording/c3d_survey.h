#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "myoid/c3d/c3d_file.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// What a C3D file says and holds, without its samples.
struct C3dSurvey {
  C3dFile file;  ///< `points` and `analog` are empty.
  Eigen::Index frames = 0;
  std::vector<Eigen::Index> missing_frames;  ///< Of each point.
  Eigen::VectorXd lowest, highest;           ///< Of each channel, in the unit as written.
  std::vector<PlateSetup> plates;
  std::vector<double> largest_force_n;  ///< Of each plate.
  std::vector<Repair> repairs;          ///< Those of the file and of its plates.
};

/// Looks through all samples, some frames at a time: needs hardly any memory, and the time of
/// reading the file once. Throws like `read_c3d`.
[[nodiscard]] C3dSurvey survey_c3d(const std::filesystem::path& path);

}  // namespace myoid::recording
