#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include <Eigen/Geometry>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/math/random.h"
#include "myoid/recording/signals/rigid_segment.h"

namespace myoid::test {

/// Where five markers A..E sit on a forearm [m].
inline Eigen::Matrix3Xd forearm_shape() {
  Eigen::Matrix3Xd local(3, 5);
  local << 0.00, 0.05, 0.02, 0.04, -0.02,  //
      0.00, -0.25, -0.12, -0.20, -0.06,    //
      0.03, 0.02, -0.03, 0.05, 0.01;
  return local;
}

/// They move with the forearm, which swings and is carried along, with this much noise.
inline MarkerSeries moving_markers(Eigen::Index frames = 400,
                                   double rate_hz = 100.0,
                                   double noise_m = 0.0005,
                                   std::uint64_t seed = 1) {
  math::Random random(seed);
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(frames, 0.0, static_cast<double>(frames - 1) / rate_hz);
  const Eigen::Matrix3Xd local = forearm_shape();
  for (Eigen::Index m = 0; m < local.cols(); ++m) markers.names.emplace_back(1, static_cast<char>('A' + m));
  markers.positions_m.resize(frames, 3 * local.cols());
  for (Eigen::Index f = 0; f < frames; ++f) {
    const double t = markers.time_s[f];
    const Mat3 R = (Eigen::AngleAxisd(1.2 * std::sin(3.0 * t), Vec3::UnitZ()) *
                    Eigen::AngleAxisd(0.4 * std::sin(5.0 * t), Vec3::UnitX()))
                       .toRotationMatrix();
    const Vec3 p(0.2 * std::sin(2.0 * t), 1.2 + 0.1 * std::cos(4.0 * t), 0.3 * t);
    for (Eigen::Index m = 0; m < local.cols(); ++m) {
      const Vec3 noise(random.normal(), random.normal(), random.normal());
      markers.positions_m.block<1, 3>(f, 3 * m) = (R * local.col(m) + p + noise_m * noise).transpose();
    }
  }
  return markers;
}

inline void hide(MarkerSeries& markers, Eigen::Index marker, Eigen::Index begin, Eigen::Index end) {
  markers.positions_m.block(begin, 3 * marker, end - begin, 3).setConstant(std::nan(""));
}

inline recording::RigidSegment forearm() { return {"forearm", {0, 1, 2, 3, 4}}; }

}  // namespace myoid::test
