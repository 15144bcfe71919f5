#include "myoid/signals/load_cell.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::signals {
namespace {

double median(Eigen::VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

TimeSeries load_cell_wrench(const TimeSeries& recorded, const LoadCell& cell) {
  if (cell.channels.size() != 6) {
    throw InvalidInput(
        fmt::format("a load cell has 6 channels (three forces, three moments), {} "
                    "are named",
                    cell.channels.size()));
  }
  if (!cell.calibration.allFinite())
    throw InvalidInput("the calibration matrix of the load cell has values that are no numbers");
  const TimeSeries channels = recorded.select(cell.channels);
  require_finite(channels, "load cell");
  const TimeSeries rest = channels.slice(cell.zero_start_s, cell.zero_end_s);
  if (rest.sample_count() < 10) {
    throw InvalidInput(
        fmt::format("the load cell has {} samples from {} to {} s, where its zero is "
                    "taken; 10 or more are needed",
                    rest.sample_count(), cell.zero_start_s, cell.zero_end_s));
  }
  Eigen::RowVectorXd zero(6);
  for (Eigen::Index c = 0; c < 6; ++c) zero[c] = median(rest.values().col(c));
  Eigen::MatrixXd wrench =
      cell.sign * (channels.values().rowwise() - zero) * cell.calibration.transpose();
  return {channels.time_s(),
          {{"Fx", Unit::newton},
           {"Fy", Unit::newton},
           {"Fz", Unit::newton},
           {"Mx", Unit::newton_meter},
           {"My", Unit::newton_meter},
           {"Mz", Unit::newton_meter}},
          std::move(wrench)};
}

}  // namespace myoid::signals
