#pragma once

#include <cmath>

#include <Eigen/Core>
#include <ceres/jet.h>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {

/// A number with its derivatives by the six coordinates of a segment's two ends.
using Jet6 = ceres::Jet<double, 6>;
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

[[nodiscard]] inline double value_of(double x) { return x; }
[[nodiscard]] inline double value_of(const Jet6& x) { return x.a; }
[[nodiscard]] inline Vec3 value_of(const Vec3& v) { return v; }
[[nodiscard]] inline Vec3 value_of(const Vector3<Jet6>& v) { return {v[0].a, v[1].a, v[2].a}; }

/// Returns the angle plus the whole turns that bring it between 0 and 2 pi.
template <typename T>
[[nodiscard]] T within_one_turn(const T& angle) {
  return angle - T(2.0 * kPi * std::floor(value_of(angle) / (2.0 * kPi)));
}

/// Contact of a path with a wrap object, in the object's frame: tangent points and arc. `T` is
/// double or, with the derivatives by both ends, Jet6.
template <typename T>
struct ContactOf {
  Vector3<T> first_W = Vector3<T>::Zero();   ///< Tangent point on the side of the path's start [m].
  Vector3<T> second_W = Vector3<T>::Zero();  ///< Tangent point on the side of its end [m].
  T arc_length_m = T(0.0);                   ///< Length of the arc between them.
};
using WrapContact = ContactOf<double>;

}  // namespace myoid::body
