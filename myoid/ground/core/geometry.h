#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace myoid::inline ground {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// A rigid transform X_AB: pose of frame B measured in frame A; p_AQ = X_AB * p_BQ.
struct Pose {
  Mat3 R = Mat3::Identity();  ///< R_AB
  Vec3 p = Vec3::Zero();      ///< p_AB, position of B's origin from A's, expressed in A [m].

  [[nodiscard]] Vec3 operator*(const Vec3& p_BQ) const { return R * p_BQ + p; }
  [[nodiscard]] Pose operator*(const Pose& X_BC) const { return {R * X_BC.R, R * X_BC.p + p}; }
  [[nodiscard]] Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Returns the rotation by body-fixed X-Y-Z Euler angles [rad]: Rx(a) Ry(b) Rz(c), OpenSim's `orientation`.
[[nodiscard]] inline Mat3 rotation_body_xyz(const Vec3& angles_rad) {
  return (Eigen::AngleAxisd(angles_rad.x(), Vec3::UnitX()) * Eigen::AngleAxisd(angles_rad.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(angles_rad.z(), Vec3::UnitZ()))
      .toRotationMatrix();
}

/// Returns the matrix S(a) with S(a) b = a x b.
[[nodiscard]] inline Mat3 skew(const Vec3& a) {
  Mat3 s;
  s << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return s;
}

}  // namespace myoid::inline ground
