#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::opensim {

/// The value of a coordinate without a column: its default value (inverse dynamics) or 0 (the analyses of AnalyzeTool,
/// where a locked or prescribed coordinate keeps the model's value).
enum class MissingCoordinate { default_value, zero };

/// Reads the coordinates of a motion or states file, in the model's order [rad, m]. Columns have the name of the
/// coordinate, "joint/coordinate/value" or "/jointset/joint/coordinate/value". Only angles are converted from degrees.
/// Throws ReadError as read_storage, and InvalidInput if no column is a coordinate.
[[nodiscard]] TimeSeries read_coordinates(const body::BodyModel& model,
                                          const std::filesystem::path& path,
                                          MissingCoordinate missing,
                                          std::vector<Remark>& remarks);

/// Returns the row of the greatest time that is not after `time_s`; the first row if all times are later.
[[nodiscard]] Eigen::Index row_at(const Eigen::VectorXd& times_s, double time_s);

/// Returns rows of a series or a motion; `rows` is a list or a sequence of Eigen.
template <typename Rows>
[[nodiscard]] TimeSeries rows_of(const TimeSeries& series, const Rows& rows) {
  return {series.time_s()(rows), series.channels(), series.values()(rows, Eigen::all)};
}
template <typename Rows>
[[nodiscard]] body::JointMotion rows_of(const body::JointMotion& motion, const Rows& rows) {
  return {rows_of(motion.q, rows), rows_of(motion.qdot, rows), rows_of(motion.qddot, rows)};
}

/// Returns the series of coordinates with only its angles in radians. OpenSim gives coupled
/// coordinates no unit in files and never converts them to degrees.
[[nodiscard]] TimeSeries with_file_units(const body::BodyModel& model, const TimeSeries& q);

/// Returns a table whose row i `fill(i, row)` writes, one for each time.
template <typename Fill>
[[nodiscard]] TimeSeries frame_table(const Eigen::VectorXd& times_s, std::vector<Channel> channels, const Fill& fill) {
  Eigen::MatrixXd values(times_s.size(), static_cast<Eigen::Index>(channels.size()));
  for (Eigen::Index i = 0; i < values.rows(); ++i) fill(i, values.row(i));
  return {times_s, std::move(channels), std::move(values)};
}

/// A table that grows column by column.
class ColumnTable {
 public:
  void add(std::string name, Unit unit, Eigen::VectorXd values) {
    channels_.push_back({std::move(name), unit});
    columns_.push_back(std::move(values));
  }
  [[nodiscard]] TimeSeries at_times(const Eigen::VectorXd& times_s) const;

 private:
  std::vector<Channel> channels_;
  std::vector<Eigen::VectorXd> columns_;
};

/// The lines on units in the headers of OpenSim's result files.
inline constexpr const char* kUnitsNote =
    "Units are S.I. units (second, meters, Newtons, ...)\nIf the header above contains a line with "
    "'inDegrees', this indicates whether rotational values are in degrees (yes) or radians "
    "(no).\n\n";

struct OpensimFormat {
  std::string title{};
  bool in_degrees = false;    ///< Columns in radians are written in degrees.
  std::string description{};  ///< Lines between the header and `endheader`.
  int decimals = 8;
};

/// Writes a storage file as OpenSim's tools do: version 1, fixed decimals in columns eight characters wider than the
/// decimals, NaN for unknown values. The file appears whole or not at all.
void write_opensim_storage(const std::filesystem::path& path, const TimeSeries& series, const OpensimFormat& format);

}  // namespace myoid::opensim
