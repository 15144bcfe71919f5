#pragma once

#include <algorithm>
#include <vector>

#include "myoid/body/kinematics/pose_fit.h"

namespace myoid::test {

/// The markers that model and recording both have, each with weight 1.
inline std::vector<body::PoseFit::Pair> marker_pairs(const body::BodyModel& model, const MarkerSeries& markers) {
  std::vector<body::PoseFit::Pair> pairs;
  for (std::size_t i = 0; i < model.markers.size(); ++i) {
    const auto it = std::find(markers.names.begin(), markers.names.end(), model.markers[i].name);
    if (it != markers.names.end()) pairs.push_back({i, it - markers.names.begin(), 1.0});
  }
  return pairs;
}

}  // namespace myoid::test
