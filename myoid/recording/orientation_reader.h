#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// Orientations of inertial sensors over time.
struct OrientationSeries {
  Eigen::VectorXd time_s;          ///< Strictly increasing.
  std::vector<std::string> names;  ///< Unique.
  /// Frames x (4 sensors): unit quaternions w, x, y, z of the sensor's axes in the laboratory; a
  /// missing orientation is NaN in all four.
  Eigen::MatrixXd quaternions;
  std::vector<Repair> repairs{};

  /// Returns R_LS, which turns vectors from the sensor's axes into the laboratory's; NaN if the orientation is missing.
  [[nodiscard]] Mat3 rotation(Eigen::Index frame, std::size_t sensor) const;
};

/// Reads an OpenSim storage file with `DataType=Quaternion`: one column a sensor, cells "w,x,y,z".
/// Quaternions are normalized. Repairs and errors are those of `read_storage`. Also throws
/// ReadError for a file of another kind, a table without sensors, and a quaternion of length 0.
[[nodiscard]] OrientationSeries read_orientations(const std::filesystem::path& path);

}  // namespace myoid::recording
