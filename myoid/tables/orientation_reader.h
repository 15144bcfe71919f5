#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/geometry.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {

/// Orientations of inertial sensors over time.
struct OrientationSeries {
  Eigen::VectorXd time_s;          ///< Strictly increasing.
  std::vector<std::string> names;  ///< Unique.
  /// Frames x (4 sensors): unit quaternions w, x, y, z of the sensor's axes in the laboratory; NaN
  /// in all four where one is missing.
  Eigen::MatrixXd quaternions;
  std::vector<Repair> repairs{};

  /// R_LS: turns vectors from the sensor's axes into the laboratory's; NaN if missing.
  [[nodiscard]] Mat3 rotation(Eigen::Index frame, std::size_t sensor) const;
};

/// Reads an OpenSim storage file with `DataType=Quaternion`: a column for each sensor, a cell
/// "w,x,y,z". Quaternions are brought to length 1. What `read_storage` mends it mends here too.
/// Throws ReadError with the line as `read_storage` does, and for a file of another kind, a table
/// without sensors, and a quaternion of length 0.
[[nodiscard]] OrientationSeries read_orientations(const std::filesystem::path& path);

}  // namespace myoid::recording
