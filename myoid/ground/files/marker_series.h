#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/geometry.h"

namespace myoid::inline ground {

/// Marker positions over time, in the laboratory's frame. A missing marker is NaN in all three coordinates.
struct MarkerSeries {
  Eigen::VectorXd time_s;          ///< Strictly increasing.
  std::vector<std::string> names;  ///< Unique.
  Eigen::MatrixXd positions_m;     ///< Frames x (3 markers): x, y, z of the first marker, then the second, ...

  [[nodiscard]] Eigen::Index frame_count() const { return time_s.size(); }
  [[nodiscard]] Eigen::Index marker_count() const { return static_cast<Eigen::Index>(names.size()); }
  [[nodiscard]] Vec3 position(Eigen::Index frame, Eigen::Index marker) const {
    return positions_m.block<1, 3>(frame, 3 * marker).transpose();
  }
  [[nodiscard]] bool missing(Eigen::Index frame, Eigen::Index marker) const {
    return !positions_m.block<1, 3>(frame, 3 * marker).allFinite();
  }
};

/// Turns every position by R: p_new = R p. For a laboratory whose vertical is not y.
[[nodiscard]] MarkerSeries rotated(MarkerSeries markers, const Mat3& R);

/// Returns the rotation that turns the laboratory's vertical ('x', 'y' or 'z') to y about a
/// coordinate axis: for z it maps x -> x, y -> -z, z -> y.
[[nodiscard]] Mat3 rotation_to_y_up(char up);

}  // namespace myoid::inline ground
