#include <algorithm>
#include <cmath>

#include "myoid/body/model/opensim_defects/wrap_opensim_surfaces.h"

namespace myoid::body {
namespace {

/// MINPACK's Levenberg-Marquardt for one residual of one variable, with the constants that OpenSim
/// gives it. Returns the variable.
template <typename Residual>
double levenberg_marquardt_1(const Residual& residual) {
  constexpr double kTolerance = 1e-4;
  constexpr double kStep = 1e-5;
  constexpr double kFactor = 0.2;
  constexpr int kMostCalls = 500;
  constexpr double kTiny = 2.2250738585072014e-308;
  double x = 0.0;
  double f = residual(x);
  double norm = std::abs(f);
  double par = 0.0;
  double diag = 0.0;
  double delta = 0.0;
  double x_norm = 0.0;
  int calls = 1;
  for (int iteration = 1;; ++iteration) {
    const double slope = (residual(x + kStep) - f) / kStep;
    ++calls;
    if (iteration == 1) {
      diag = slope != 0.0 ? std::abs(slope) : 1.0;
      x_norm = std::abs(diag * x);
      delta = x_norm != 0.0 ? kFactor * x_norm : kFactor;
    }
    if (norm == 0.0 || slope == 0.0) return x;
    diag = std::max(diag, std::abs(slope));
    for (double ratio = 0.0; ratio < 1e-4;) {
      // The step with a scaled length of delta to within a tenth, or the full step.
      double step = f / slope;
      double scaled = std::abs(diag * step);
      double excess = scaled - delta;
      if (excess <= 0.1 * delta) {
        par = 0.0;
      } else {
        const double t = diag / std::abs(slope);
        double lower = excess / delta / t / t;
        const double gradient = std::abs(slope * f / diag);
        double upper = gradient / delta;
        if (upper == 0.0) upper = kTiny / std::min(delta, 0.1);
        par = std::min(std::max(par, lower), upper);
        if (par == 0.0) par = gradient / scaled;
        for (int k = 1;; ++k) {
          if (par == 0.0) par = std::max(kTiny, 0.001 * upper);
          const double damped = slope * slope + par * diag * diag;
          step = slope * f / damped;
          scaled = std::abs(diag * step);
          const double before = excess;
          excess = scaled - delta;
          if (std::abs(excess) <= 0.1 * delta || (lower == 0.0 && excess <= before && before < 0.0) || k == 10) break;
          const double w = diag / std::sqrt(damped);
          const double correction = excess / delta / w / w;
          if (excess > 0.0) lower = std::max(lower, par);
          if (excess < 0.0) upper = std::min(upper, par);
          par = std::max(lower, par + correction);
        }
      }
      const double trial = x - step;
      const double length = std::abs(diag * step);
      if (iteration == 1) delta = std::min(delta, length);
      const double f_trial = residual(trial);
      ++calls;
      const double norm_trial = std::abs(f_trial);
      const double actual = 0.1 * norm_trial < norm ? 1.0 - (norm_trial / norm) * (norm_trial / norm) : -1.0;
      const double t1 = std::abs(slope * step) / norm;
      const double t2 = std::sqrt(par) * length / norm;
      const double predicted = t1 * t1 + t2 * t2 / 0.5;
      const double direction = -(t1 * t1 + t2 * t2);
      ratio = predicted != 0.0 ? actual / predicted : 0.0;
      if (ratio <= 0.25) {
        double shrink = actual >= 0.0 ? 0.5 : 0.5 * direction / (direction + 0.5 * actual);
        if (0.1 * norm_trial >= norm || shrink < 0.1) shrink = 0.1;
        delta = shrink * std::min(delta, length / 0.1);
        par /= shrink;
      } else if (par == 0.0 || ratio >= 0.75) {
        delta = length / 0.5;
        par *= 0.5;
      }
      if (ratio >= 1e-4) {
        x = trial;
        x_norm = std::abs(diag * x);
        f = f_trial;
        norm = norm_trial;
      }
      if (std::abs(actual) <= kTolerance && predicted <= kTolerance && 0.5 * ratio <= 1.0) return x;
      if (delta <= kTolerance * x_norm || calls >= kMostCalls || !std::isfinite(norm)) return x;
    }
  }
}

/// The point of the circle of radius R about z in z = 0 nearest to the line from `begin`, by OpenSim's method.
struct NearCircle {
  Vec3 on_line;
  double distance = 0.0;
};
NearCircle near_circle(const Vec3& begin, const Vec3& end, double R, const Compat& compat) {
  const Vec3 n = (end - begin).normalized();
  const double c2 = 2.0 * begin.dot(n);
  const double c3 = begin.head<2>().dot(n.head<2>());
  const double c4 = n.head<2>().squaredNorm();
  const double c5 = begin.head<2>().squaredNorm();
  const double factor = compat.approximate_torus ? 2.0 : 1.0;
  const double u = levenberg_marquardt_1([&](double s) {
    return c2 + 2.0 * s - 2.0 * R * factor * (c4 * s + c3) / std::sqrt(s * s * c4 + 2.0 * c3 * s + c5);
  });
  NearCircle near;
  near.on_line = begin + u * n;
  near.distance = std::sqrt(near.on_line.squaredNorm() + R * R - 2.0 * R * near.on_line.head<2>().norm());
  return near;
}

}  // namespace

OpenSimContact opensim_torus_contact(
    const TorusShape& torus, const Side& side, const Vec3& p, const Vec3& q, bool single, const Compat& compat) {
  constexpr double kLong_m = 10000.0;
  OpenSimContact result;
  const NearCircle forth = near_circle(p, q, torus.outer_radius_m, compat);
  const NearCircle back = near_circle(q, p, torus.outer_radius_m, compat);
  bool take_forth = forth.distance < back.distance;
  if (side.sign != 0) {
    const bool forth_counts = side.has(forth.on_line);
    const bool back_counts = side.has(back.on_line);
    if (!forth_counts && !back_counts) return result;
    if (forth_counts != back_counts) take_forth = forth_counts;
  }
  const Vec3& chosen = take_forth ? forth.on_line : back.on_line;
  const Vec3 on_circle = Vec3(chosen.x(), chosen.y(), 0.0) * (torus.outer_radius_m / chosen.head<2>().norm());
  // A cylinder along the circle there; its x axis points to the middle of the ring.
  Mat3 R;
  R.row(0) = -on_circle.normalized();
  R.row(1) = -Vec3::UnitZ();
  R.row(2) = R.row(0).cross(R.row(1));
  const OpenSimContact c = opensim_cylinder_contact(CylinderShape{torus.inner_radius_m, kLong_m}, Side(1),
                                                    R * (p - on_circle), R * (q - on_circle), single, compat);
  result = c;
  result.action = WrapAction::wrapped;
  result.first_W = R.transpose() * c.first_W + on_circle;
  result.second_W = R.transpose() * c.second_W + on_circle;
  return result;
}

}  // namespace myoid::body
