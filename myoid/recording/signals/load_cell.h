#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"

namespace myoid::recording {

/// A load cell with six channels that are linear in force and moment.
struct LoadCell {
  using Matrix = Eigen::Matrix<double, 6, 6>;

  std::vector<std::string> channels;  ///< Six channels, in the order of the matrix's columns.
  Matrix calibration;                 ///< Rows Fx, Fy, Fz [N] and Mx, My, Mz [N m], per volt.
  double sign = 1.0;                  ///< -1 if the cell measures the opposite action.
  double zero_start_s = 0.0;          ///< Begin of a time without load.
  double zero_end_s = 1.0;            ///< End of that time; its median is the zero of each channel.
};

/// Returns force and moment in the cell's own axes, channels Fx, Fy, Fz [N] and Mx, My, Mz [N m]:
///
///   w(t) = sign C (v(t) - median of v in the time without load)
///
/// Throws InvalidInput if a channel is missing, there are not six, the time without load holds
/// fewer than 10 samples or a value is not finite.
[[nodiscard]] TimeSeries load_cell_wrench(const TimeSeries& recorded, const LoadCell& cell);

}  // namespace myoid::recording
