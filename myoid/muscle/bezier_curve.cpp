#include "myoid/muscle/bezier_curve.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

using Quintic = std::array<double, 6>;

double value(const Quintic& c, double u) { return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5])))); }
double derivative(const Quintic& c, double u) {
  return c[1] + u * (2.0 * c[2] + u * (3.0 * c[3] + u * (4.0 * c[4] + u * 5.0 * c[5])));
}

/// Returns the powers of u from control points p0, p1, p1, p3, p3, p5.
Quintic quintic(double p0, double p1, double p3, double p5) {
  return {p0,
          5.0 * (p1 - p0),
          10.0 * (p0 - p1),
          10.0 * (p3 - p0),
          5.0 * (p0 + 2.0 * p1 - 3.0 * p3),
          -p0 - 5.0 * p1 + 5.0 * p3 + p5};
}

/// Solves a x(u) + b y(u) = target, rising in u, for u in 0..1: Newton within a bracket.
double solve_parameter(const Quintic& x, const Quintic& y, double a, double b, double target) {
  Quintic q;
  for (std::size_t k = 0; k < 6; ++k) q[k] = a * x[k] + b * y[k];
  double low = 0.0;
  double high = 1.0;
  const double end = value(q, 1.0);
  double u = (target - q[0]) / (end - q[0]);
  if (!(u > 0.0)) return 0.0;
  if (u >= 1.0) return 1.0;
  const double enough = 1e-16 * (std::abs(end) + std::abs(q[0]));
  for (int k = 0; k < 60; ++k) {
    const double miss = value(q, u) - target;
    if (std::abs(miss) <= enough) break;
    (miss > 0.0 ? high : low) = u;
    double next = u - miss / derivative(q, u);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = next - u;
    u = next;
    if (std::abs(step) < 1e-16) break;
  }
  return u;
}

/// Returns the integral of y dx from 0 to u by Gauss-Legendre with five points, which is exact for degree nine.
double area(const Quintic& x, const Quintic& y, double u) {
  constexpr std::array<double, 5> node{-0.9061798459386639928, -0.5384693101056830910, 0.0, 0.5384693101056830910,
                                       0.9061798459386639928};
  constexpr std::array<double, 5> weight{0.2369268850561890875, 0.4786286704993664680, 0.5688888888888888889,
                                         0.4786286704993664680, 0.2369268850561890875};
  double sum = 0.0;
  for (std::size_t k = 0; k < 5; ++k) {
    const double s = 0.5 * u * (1.0 + node[k]);
    sum += weight[k] * value(y, s) * derivative(x, s);
  }
  return 0.5 * u * sum;
}

}  // namespace

BezierCurve::BezierCurve(std::span<const CurveKnot> knots, std::span<const double> curviness)
    : count_(static_cast<int>(curviness.size())) {
  if (knots.size() != curviness.size() + 1 || count_ < 1 || count_ > kMaxSegments) {
    throw InvalidInput(
        fmt::format("a curve of {} knots and {} corners: expected one knot more than corners, and at most {} corners",
                    knots.size(), curviness.size(), kMaxSegments));
  }
  for (int k = 0; k < count_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const CurveKnot& p = knots[i];
    const CurveKnot& q = knots[i + 1];
    const double c = curviness[i];
    const bool parallel = std::abs(p.slope - q.slope) < 1.5e-8;
    const double meet_x =
        parallel ? 0.5 * (p.x + q.x) : (q.y - p.y - q.x * q.slope + p.x * p.slope) / (p.slope - q.slope);
    const double meet_y = (meet_x - q.x) * q.slope + q.y;
    if (!(c > 0.0 && c <= 1.0) || !(meet_x > p.x && meet_x < q.x)) {
      throw InvalidInput(
          fmt::format("the corner of a curve from ({:g}, {:g}) with slope {:g} to ({:g}, {:g}) with slope {:g}, "
                      "curviness {:g}: its tangents must meet between the two and the curviness lie in (0, 1]",
                      p.x, p.y, p.slope, q.x, q.y, q.slope, c));
    }
    Segment& s = segments_[i];
    s.from = p;
    s.x = quintic(p.x, p.x + c * (meet_x - p.x), q.x + c * (meet_x - q.x), q.x);
    s.y = quintic(p.y, p.y + c * (meet_y - p.y), q.y + c * (meet_y - q.y), q.y);
    s.cells_per_x = kCells / (q.x - p.x);
    for (int cell = 0; cell <= kCells; ++cell) {
      const double u = solve_parameter(s.x, s.y, 1.0, 0.0, p.x + cell / s.cells_per_x);
      s.guess[static_cast<std::size_t>(cell)] = {u, 1.0 / (derivative(s.x, u) * s.cells_per_x)};
    }
    s.area_before = area_;
    area_ += area(s.x, s.y, 1.0);
  }
  first_ = knots.front();
  last_ = knots.back();
}

const BezierCurve::Segment& BezierCurve::segment_at(double x) const {
  int k = count_ - 1;
  while (k > 0 && x < segments_[static_cast<std::size_t>(k)].from.x) --k;
  return segments_[static_cast<std::size_t>(k)];
}

/// Returns u where x(u) = x. A cubic through the ends of the neighboring cells is off by a few 1e-3 at most, in sharp
/// corners, and three Newton steps each square the error. If they fail, the bracket decides.
double BezierCurve::parameter_at(const Segment& s, double x) {
  const double position = (x - s.from.x) * s.cells_per_x;
  const int cell = std::min(static_cast<int>(position), kCells - 1);
  const double t = position - cell;
  const auto& [u0, d0] = s.guess[static_cast<std::size_t>(cell)];
  const auto& [u1, d1] = s.guess[static_cast<std::size_t>(cell) + 1];
  const double rise = u1 - u0;
  double u = u0 + t * (d0 + t * (3.0 * rise - 2.0 * d0 - d1 + t * (d0 + d1 - 2.0 * rise)));
  double step = 0.0;
  for (int k = 0; k < 3; ++k) {
    step = (value(s.x, u) - x) / derivative(s.x, u);
    u -= step;
  }
  return std::abs(step) < 1e-9 ? u : solve_parameter(s.x, s.y, 1.0, 0.0, x);
}

CurvePoint<double> BezierCurve::at(double x) const {
  if (x <= first_.x) return {first_.y + first_.slope * (x - first_.x), first_.slope};
  if (x >= last_.x) return {last_.y + last_.slope * (x - last_.x), last_.slope};
  const Segment& s = segment_at(x);
  const double u = parameter_at(s, x);
  return {value(s.y, u), derivative(s.y, u) / derivative(s.x, u)};
}

double BezierCurve::integral_to(double x) const {
  if (x <= first_.x) {
    const double d = x - first_.x;
    return first_.y * d + 0.5 * first_.slope * d * d;
  }
  if (x >= last_.x) {
    const double d = x - last_.x;
    return area_ + last_.y * d + 0.5 * last_.slope * d * d;
  }
  const Segment& s = segment_at(x);
  return s.area_before + area(s.x, s.y, parameter_at(s, x));
}

double BezierCurve::solve(double strength, double damping, double force) const {
  const auto load = [&](double x, double y) { return strength * y + damping * x; };
  if (force <= load(first_.x, first_.y)) {
    return first_.x + (force - load(first_.x, first_.y)) / (strength * first_.slope + damping);
  }
  if (force >= load(last_.x, last_.y)) {
    return last_.x + (force - load(last_.x, last_.y)) / (strength * last_.slope + damping);
  }
  int k = count_ - 1;
  while (k > 0) {
    const CurveKnot& from = segments_[static_cast<std::size_t>(k)].from;
    if (force >= load(from.x, from.y)) break;
    --k;
  }
  const Segment& s = segments_[static_cast<std::size_t>(k)];
  return value(s.x, solve_parameter(s.x, s.y, damping, strength, force));
}

}  // namespace myoid::muscle
