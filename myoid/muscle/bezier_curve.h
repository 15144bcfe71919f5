#pragma once

#include <array>
#include <span>

#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// A point a curve passes through, with its slope there.
struct CurveKnot {
  double x = 0.0;
  double y = 0.0;
  double slope = 0.0;
};

/// A smooth curve y(x) of at most five corners, each a parametric quintic (x(u), y(u)), u in 0..1,
/// and straight lines on both sides. Each corner joins two knots tangentially: with C the point
/// where the tangents meet and c in (0, 1] the curviness, its control points are P0, P0 + c (C -
/// P0) twice, P1 + c (C - P1) twice, P1. Hence zero curvature at the knots and two continuous
/// derivatives everywhere. As Millard et al. (2013) build the curves of a muscle. Immutable.
class BezierCurve {
 public:
  static constexpr int kMaxSegments = 5;

  /// Knots in increasing x, one more than corners; one curviness per corner. Throws InvalidInput if
  /// two tangents do not meet between their knots (the corner would be S-shaped).
  BezierCurve(std::span<const CurveKnot> knots, std::span<const double> curviness);

  /// Returns y and dy/dx.
  template <typename T>
  [[nodiscard]] CurvePoint<T> operator()(const T& x) const {
    const CurvePoint<double> point = at(value_of(x));
    return {linearized(x, point.value, point.slope), point.slope};
  }

  /// Returns the integral of y from the first knot to x.
  template <typename T>
  [[nodiscard]] T integral(const T& x) const {
    const double number = value_of(x);
    return linearized(x, integral_to(number), at(number).value);
  }

  /// Returns the x at which strength * y(x) + damping * x = force, for a curve that never falls.
  /// strength and damping are at least 0, and one of them has an effect at x.
  [[nodiscard]] double solve(double strength, double damping, double force) const;

  [[nodiscard]] const CurveKnot& first() const { return first_; }
  [[nodiscard]] const CurveKnot& last() const { return last_; }

 private:
  static constexpr int kCells = 8;
  using Quintic = std::array<double, 6>;  ///< Coefficients, lowest power first.
  struct Segment {
    CurveKnot from;
    Quintic x;
    Quintic y;
    double area_before = 0.0;  ///< Integral of y from the first knot to this segment.
    /// u and du per cell at x evenly spaced from `from.x`: where Newton begins.
    std::array<std::array<double, 2>, kCells + 1> guess{};
    double cells_per_x = 0.0;
  };

  [[nodiscard]] CurvePoint<double> at(double x) const;
  [[nodiscard]] double integral_to(double x) const;
  [[nodiscard]] const Segment& segment_at(double x) const;
  [[nodiscard]] static double parameter_at(const Segment& s, double x);

  int count_ = 0;
  std::array<Segment, kMaxSegments> segments_;
  CurveKnot first_;
  CurveKnot last_;
  double area_ = 0.0;  ///< Integral of y over all segments.
};

}  // namespace myoid::muscle
