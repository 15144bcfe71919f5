#include "myoid/body/dynamics/contact_force.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

struct Touch {
  double depth_m = 0.0;  ///< Positive where the surfaces overlap.
  Vec3 normal_G;         ///< From the sphere into the other.
  Vec3 p_G;              ///< Midway between the surfaces.
  double radius_m = 0.0;
};

Touch touch_of(const body::Contact& c, const body::BodyState& state) {
  const Vec3 center = state.X_GB[at(c.sphere_body)] * c.p_BS;
  const Pose X_GO = state.X_GB[at(c.other_body)] * c.X_BO;
  Touch t;
  if (c.other_radius_m) {
    const Vec3 line = X_GO.p - center;
    const double distance = line.norm();
    t.depth_m = c.radius_m + *c.other_radius_m - distance;
    t.normal_G = distance > 0.0 ? Vec3(line / distance) : Vec3::UnitY();
    t.radius_m = c.radius_m * *c.other_radius_m / (c.radius_m + *c.other_radius_m);
  } else {
    t.normal_G = X_GO.R.col(0);
    t.depth_m = (center - X_GO.p).dot(t.normal_G) + c.radius_m;
    t.radius_m = c.radius_m;
  }
  t.p_G = center + (c.radius_m - 0.5 * t.depth_m) * t.normal_G;
  return t;
}

/// Combines two coefficients of friction by their harmonic mean.
double together(double a, double b) { return a != 0.0 || b != 0.0 ? 2.0 * a * b / (a + b) : 0.0; }

}  // namespace

void append_contact(const body::Contact& c, const body::BodyState& state, std::vector<body::BodyWrench>& wrenches) {
  Touch t = touch_of(c, state);
  if (!c.smoothing && t.depth_m <= 0.0) return;
  const auto& [first, second] = c.materials;
  // Moduli to the power 2/3 act in series: the softer surface takes the larger part of the depth.
  const double k1 = std::pow(first.stiffness, 2.0 / 3.0);
  const double k2 = std::pow(second.stiffness, 2.0 / 3.0);
  const double share = k2 / (k1 + k2);
  const double k = k1 * share;
  const double dissipation = first.dissipation * share + second.dissipation * (1.0 - share);
  t.p_G += t.depth_m * (0.5 - share) * t.normal_G;
  const Vec3 v = body::point_velocity(state, c.sphere_body, t.p_G) - body::point_velocity(state, c.other_body, t.p_G);
  const double approach = v.dot(t.normal_G);
  const Vec3 sliding = v - approach * t.normal_G;
  double force = 0.0, slip = sliding.norm();
  if (c.smoothing) {
    const body::Contact::Smoothing& s = *c.smoothing;
    const double depth = std::sqrt(t.depth_m * t.depth_m + s.constant);
    const double hertz =
        4.0 / 3.0 * k * std::sqrt(t.radius_m * k) * std::pow(depth, 1.5) * (0.5 + 0.5 * std::tanh(s.hertz * t.depth_m));
    force = hertz * (1.0 + 1.5 * dissipation * approach) *
            (0.5 + 0.5 * std::tanh(s.hunt_crossley * (approach + 2.0 / (3.0 * dissipation))));
    slip = std::sqrt(sliding.squaredNorm() + s.constant);
  } else {
    const double hertz = 4.0 / 3.0 * k * t.depth_m * std::sqrt(t.radius_m * k * t.depth_m);
    force = std::max(0.0, hertz * (1.0 + 1.5 * dissipation * approach));
  }
  Vec3 on_other = force * t.normal_G;
  if (slip > 0.0) {
    const double us = together(first.static_friction, second.static_friction);
    const double ud = together(first.dynamic_friction, second.dynamic_friction);
    const double uv = together(first.viscous_friction, second.viscous_friction);
    const double relative = slip / c.transition_velocity_mps;
    const double friction =
        force * (std::min(relative, 1.0) * (ud + 2.0 * (us - ud) / (1.0 + relative * relative)) + uv * slip);
    on_other += friction / slip * sliding;
  }
  wrenches.push_back(body::wrench_at(state, c.sphere_body, t.p_G, -on_other));
  wrenches.push_back(body::wrench_at(state, c.other_body, t.p_G, on_other));
}

}  // namespace myoid::body
