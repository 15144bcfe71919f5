#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/time_series.h"

namespace myoid::signals {

/// A load cell of six channels that are linear in force and moment.
struct LoadCell {
  using Matrix = Eigen::Matrix<double, 6, 6>;

  std::vector<std::string> channels;  ///< Six, in the order of the matrix's columns.
  Matrix calibration;                 ///< Rows Fx, Fy, Fz [N] and Mx, My, Mz [N m] for each volt.
  double sign = 1.0;          ///< -1 where the cell measures the opposite of what is wanted.
  double zero_start_s = 0.0;  ///< In this time nothing acts on the cell ...
  double zero_end_s = 1.0;    ///< ... its median is the zero of each channel.
};

/// Force and moment in the cell's own axes, channels Fx, Fy, Fz [N] and Mx, My, Mz [N m]:
///
///   w(t) = sign C (v(t) - median of v in the time of the zero)
///
/// Throws InvalidInput if a channel is missing, there are not six, the time of the zero holds fewer
/// than 10 samples or a value is not finite.
[[nodiscard]] TimeSeries load_cell_wrench(const TimeSeries& recorded, const LoadCell& cell);

}  // namespace myoid::signals
