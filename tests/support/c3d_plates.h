#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// Returns all plates of a file over its whole time, each facing the person as the C3D guide defines.
inline std::vector<ForcePlate> force_plates(const C3dFile& file, std::vector<Repair>& repairs) {
  std::vector<ForcePlate> plates;
  const Eigen::Index count = file.analog.rows();
  const double start = static_cast<double>(file.first_frame - 1) * file.analog_per_frame;
  for (PlateSetup& setup : plate_setups(file, repairs)) {
    turn_origin(setup, repairs);
    Eigen::VectorXd time_s(count);
    for (Eigen::Index i = 0; i < count; ++i) time_s[i] = (start + static_cast<double>(i)) / file.analog_rate_hz();
    Eigen::MatrixXd values(count, static_cast<Eigen::Index>(setup.channels.size()));
    for (std::size_t c = 0; c < setup.channels.size(); ++c) {
      const C3dChannel& channel = file.channels[static_cast<std::size_t>(setup.channels[c])];
      for (Eigen::Index i = 0; i < count; ++i)
        values(i, static_cast<Eigen::Index>(c)) =
            channel.scale * (static_cast<double>(file.analog(i, setup.channels[c])) - channel.offset);
    }
    plates.push_back(force_plate(setup, std::move(time_s), std::move(values)));
  }
  return plates;
}

}  // namespace myoid::recording
