#pragma once

#include <type_traits>

namespace myoid::muscle {

/// Returns the plain number in a scalar: the scalar itself, or the value part of an
/// automatic-differentiation type with a member `a` (ceres::Jet), to any depth.
inline double value_of(double x) { return x; }
template <typename T>
requires requires(const T& x) { x.a; }
double value_of(const T& x) { return value_of(x.a); }

/// Returns y(x) to first order about the plain number in x: the value y with the derivatives of x times the slope
/// dy/dx. Exact for first derivatives. A law that is known only as numbers enters a derivative by this function.
template <typename T>
[[nodiscard]] T linearized(const T& x, double y, double slope) {
  if constexpr (std::is_same_v<T, double>) {
    return y;
  } else {
    return T(y) + (x - T(value_of(x))) * T(slope);
  }
}

/// A point of a dimensionless curve: its value, and its slope as a plain number (for Newton steps
/// and stiffnesses; derivatives of `value` by anything come with T).
template <typename T = double>
struct CurvePoint {
  T value{};
  double slope = 0.0;
};

}  // namespace myoid::muscle
