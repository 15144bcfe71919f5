#pragma once

#include "myoid/body/model/body_model.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::test {

/// The markers of a resting model for half a second, `shift_m` in front of it.
inline MarkerSeries resting_markers(const body::BodyModel& model, double shift_m) {
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(51, 0.0, 0.5);
  markers.positions_m.resize(51, static_cast<Eigen::Index>(3 * model.markers.size()));
  for (std::size_t m = 0; m < model.markers.size(); ++m) {
    const body::Marker& marker = model.markers[m];
    const Vec3 place = state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM + shift_m * Vec3::UnitX();
    markers.names.push_back(marker.name);
    markers.positions_m.middleCols(3 * static_cast<Eigen::Index>(m), 3).rowwise() = place.transpose();
  }
  return markers;
}

}  // namespace myoid::test
