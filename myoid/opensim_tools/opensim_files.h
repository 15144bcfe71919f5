#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_model.h"

namespace myoid {

/// Coordinates of a motion or states file in the model's order [rad, m]; what the file calls
/// "joint/coordinate/value" or "/jointset/joint/coordinate/value" is the coordinate. `missing` says
/// what a coordinate without a column takes: its default value (inverse dynamics) or 0 (the
/// analyses of AnalyzeTool). Only angles are converted from degrees. Throws ReadError as
/// read_storage, and InvalidInput if no column is a coordinate.
enum class MissingCoordinate { default_value, zero };
[[nodiscard]] TimeSeries read_coordinates(const model::BodyModel& model,
                                          const std::filesystem::path& path,
                                          MissingCoordinate missing,
                                          std::vector<std::string>& notes);

/// Row of the greatest time that is not after `time_s`; the first row if all are.
[[nodiscard]] Eigen::Index row_at(const Eigen::VectorXd& times_s, double time_s);

/// Rows `first` to `last`, both included.
[[nodiscard]] TimeSeries rows_of(const TimeSeries& series, Eigen::Index first, Eigen::Index last);

/// The series of coordinates with only its angles in radians: what OpenSim calls coupled has no
/// unit in files, and is never converted to degrees.
[[nodiscard]] TimeSeries with_file_units(const model::BodyModel& model, const TimeSeries& q);

struct OpensimFormat {
  std::string title{};
  bool in_degrees = false;    ///< Columns in radians are written in degrees.
  std::string description{};  ///< Lines between the header and `endheader`.
  int decimals = 8;
};

/// Writes a storage file as OpenSim's tools do: version 1, fixed decimals in columns eight wider
/// than them, NaN for what is not known. Whole or not at all.
void write_opensim_storage(const std::filesystem::path& path,
                           const TimeSeries& series,
                           const OpensimFormat& format);

}  // namespace myoid
