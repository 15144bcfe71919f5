#include "myoid/recording/signals/load_cell.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::recording {
TimeSeries load_cell_wrench(const TimeSeries& recorded, const LoadCell& cell) {
  if (cell.channels.size() != 6) {
    throw InvalidInput("a load cell has 6 channels (three forces, three moments), {} are named", cell.channels.size());
  }
  if (!cell.calibration.allFinite())
    throw InvalidInput("the calibration matrix of the load cell has values that are no numbers");
  const TimeSeries channels = recorded.select(cell.channels);
  require_finite(channels, "load cell");
  const TimeSeries rest = channels.slice(cell.zero_start_s, cell.zero_end_s);
  if (rest.sample_count() < 10) {
    throw InvalidInput("the load cell has {} samples from {} to {} s, where its zero is taken; 10 or more are needed",
                       rest.sample_count(), cell.zero_start_s, cell.zero_end_s);
  }
  Eigen::RowVectorXd zero(6);
  for (Eigen::Index c = 0; c < 6; ++c) {
    const Eigen::VectorXd values = rest.values().col(c);
    zero[c] = math::median({values.begin(), values.end()});
  }
  Eigen::MatrixXd wrench = cell.sign * (channels.values().rowwise() - zero) * cell.calibration.transpose();
  return {channels.time_s(),
          {{"Fx", Unit::newton},
           {"Fy", Unit::newton},
           {"Fz", Unit::newton},
           {"Mx", Unit::newton_meter},
           {"My", Unit::newton_meter},
           {"Mz", Unit::newton_meter}},
          std::move(wrench)};
}

}  // namespace myoid::recording
