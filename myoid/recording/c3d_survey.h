#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "myoid/recording/c3d/c3d_file.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// The statements of a C3D file and the ranges of its samples.
struct C3dSurvey {
  C3dFile file;  ///< `points` and `analog` are empty.
  Eigen::Index frames = 0;
  std::vector<Eigen::Index> missing_frames;  ///< For each point.
  Eigen::VectorXd lowest, highest;           ///< For each channel, in the unit as written.
  std::vector<PlateSetup> plates;
  std::vector<double> largest_force_n;  ///< For each plate, after its baseline.
  std::vector<Repair> repairs;          ///< Notes on the file and on its plates.
};

/// Looks through all samples, some frames at a time and with little memory. A file with force plates is then read
/// whole. Throws like `read_c3d_head`.
[[nodiscard]] C3dSurvey survey_c3d(const std::filesystem::path& path);

}  // namespace myoid::recording
