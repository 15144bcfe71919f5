#include "myoid/ground/math/shape_preserving_curve.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

/// Returns the slope at an end from the two nearest intervals: of the parabola through three
/// samples, limited so that the shape is preserved.
double end_slope(double h0, double h1, double s0, double s1) {
  const double slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
  if (slope * s0 <= 0.0) return 0.0;
  if (s0 * s1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(s0)) return 3.0 * s0;
  return slope;
}

}  // namespace

ShapePreservingCurve::ShapePreservingCurve(const Eigen::Ref<const Eigen::VectorXd>& time_s,
                                           const Eigen::Ref<const Eigen::VectorXd>& values,
                                           std::string_view what)
    : time_(time_s), value_(values), slope_(Eigen::VectorXd::Zero(time_s.size())) {
  const Eigen::Index n = time_.size();
  if (n < 2 || value_.size() != n) {
    throw InvalidInput(
        fmt::format("{}: {} times and {} values; expected as many of each, and two at least", what, n, value_.size()));
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!std::isfinite(time_(k)) || !std::isfinite(value_(k))) {
      throw InvalidInput(
          fmt::format("{}: sample {} is ({}, {}), expected finite numbers", what, k + 1, time_(k), value_(k)));
    }
    if (k > 0 && !(time_(k) > time_(k - 1))) {
      throw InvalidInput(
          fmt::format("{}: time {} s follows {} s, expected strictly increasing times", what, time_(k), time_(k - 1)));
    }
  }
  const auto h = [&](Eigen::Index k) { return time_(k + 1) - time_(k); };
  const auto s = [&](Eigen::Index k) { return (value_(k + 1) - value_(k)) / h(k); };
  if (n == 2) {
    slope_.setConstant(s(0));
    return;
  }
  slope_(0) = end_slope(h(0), h(1), s(0), s(1));
  slope_(n - 1) = end_slope(h(n - 2), h(n - 3), s(n - 2), s(n - 3));
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    const double before = s(k - 1);
    const double after = s(k);
    if (before * after <= 0.0) continue;
    const double w = h(k - 1) + 2.0 * h(k);
    const double w_after = 2.0 * h(k - 1) + h(k);
    slope_(k) = (w + w_after) / (w / before + w_after / after);
  }
}

ShapePreservingCurve::Point ShapePreservingCurve::at(double time_s) const {
  const Eigen::Index n = time_.size();
  if (time_s <= time_(0)) return {value_(0), time_s < time_(0) ? 0.0 : slope_(0)};
  if (time_s >= time_(n - 1)) return {value_(n - 1), time_s > time_(n - 1) ? 0.0 : slope_(n - 1)};
  const double* first = time_.data();
  const Eigen::Index k = std::upper_bound(first, first + n, time_s) - first - 1;
  const double h = time_(k + 1) - time_(k);
  const double t = time_s - time_(k);
  const double rise = (value_(k + 1) - value_(k)) / h;
  const double c2 = (3.0 * rise - 2.0 * slope_(k) - slope_(k + 1)) / h;
  const double c3 = (slope_(k) + slope_(k + 1) - 2.0 * rise) / (h * h);
  return {value_(k) + t * (slope_(k) + t * (c2 + t * c3)), slope_(k) + t * (2.0 * c2 + t * 3.0 * c3)};
}

}  // namespace myoid::inline ground::math
