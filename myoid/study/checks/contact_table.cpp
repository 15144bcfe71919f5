#include "myoid/study/checks/contact_table.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

constexpr Eigen::Index kFrames = 1500;

/// Returns the center of pressure on the ground; empty if the force defines none.
std::optional<Vec3> pressure_center(const body::ExternalForce& force, double data_time_s, const Vec3& up) {
  const Vec3 at = force.point->at(data_time_s);
  if (!force.point->splines.empty() || !force.torque) return at;
  const Vec3 f = force.force->at(data_time_s);
  constexpr double kSteep = 0.3;  // a flatter force cuts the plane too far away
  if (!(f.dot(up) > kSteep * f.norm())) return std::nullopt;
  return at + up.cross(force.torque->at(data_time_s)) / f.dot(up);
}

bool is_on_the_ground(const body::ExternalForce& force) {
  return force.body != 0 && force.force_frame == 0 && force.point_frame == 0 && force.force && force.point &&
         !force.force->splines.empty() && (!force.point->splines.empty() || force.torque);
}

/// Adds the lowest point of each body and its speed since the frame before.
void add_lowest(const BodyPoints& points, std::size_t bodies, const Vec3& up, ContactTable& table, ContactFrame& now) {
  now.lowest_m.resize(bodies);
  now.speed_mps.assign(bodies, std::numeric_limits<double>::infinity());
  for (std::size_t b = 1; b < bodies; ++b) {
    for (const Vec3& p : points.of(static_cast<body::BodyIndex>(b))) {
      if (!now.lowest_m[b] || p.dot(up) < now.lowest_m[b]->dot(up)) now.lowest_m[b] = p;
    }
    if (table.frames.empty()) continue;
    const ContactFrame& before = table.frames.back();
    if (now.lowest_m[b] && before.lowest_m[b] && now.time_s > before.time_s)
      now.speed_mps[b] = (*now.lowest_m[b] - *before.lowest_m[b]).norm() / (now.time_s - before.time_s);
  }
}

GroundContact contact_at(const BodyPoints& points,
                         std::size_t bodies,
                         const body::ExternalForce& force,
                         const Vec3& force_n,
                         const Vec3& center_m,
                         const Vec3& up) {
  GroundContact contact{.force_n = force_n, .center_m = center_m, .near_m = {}, .alone_m = {}};
  for (std::size_t b = 0; b < bodies; ++b) {
    contact.near_m.push_back(points.distance(center_m, static_cast<body::BodyIndex>(b)));
    contact.alone_m.push_back(points.of_one(center_m, static_cast<body::BodyIndex>(b)));
  }
  for (std::size_t k = 0; k < contact.turned_m.size(); ++k) {
    const Eigen::AngleAxisd turn(0.5 * std::numbers::pi * static_cast<double>(k), up);
    contact.turned_m[k] = points.distance(turn * center_m, force.body);
  }
  return contact;
}

}  // namespace

ContactTable contact_table(const body::BodyModel& model, const body::ExternalLoads& loads, BodyPoints points) {
  ContactTable table;
  if (model.gravity_G.norm() > 0.0) table.up = -model.gravity_G.normalized();
  const Eigen::Index n = points.frame_count();
  const Eigen::Index step = std::max<Eigen::Index>(1, n / kFrames);
  const auto data_time_s = [&](Eigen::Index frame) { return loads.data_time_s(points.time_s(frame)); };
  for (const body::ExternalForce& force : loads.forces) {
    if (!is_on_the_ground(force)) continue;
    double largest = 0.0;
    for (Eigen::Index i = 0; i < n; i += step) largest = std::max(largest, force.force->at(data_time_s(i)).norm());
    if (largest > 0.0) table.forces.push_back({&force, largest});
  }
  for (Eigen::Index i = 0; i < n && !table.forces.empty(); i += step) {
    points.pose(i);
    ContactFrame now{.time_s = points.time_s(i), .of = {}, .lowest_m = {}, .speed_mps = {}};
    add_lowest(points, model.bodies.size(), table.up, table, now);
    for (const ContactForce& one : table.forces) {
      std::optional<GroundContact>& contact = now.of.emplace_back();
      const Vec3 force_n = one.force->force->at(data_time_s(i));
      if (force_n.norm() < kLimits.contacts.least_share * one.largest_n) continue;
      if (const auto center_m = pressure_center(*one.force, data_time_s(i), table.up))
        contact = contact_at(points, model.bodies.size(), *one.force, force_n, *center_m, table.up);
    }
    table.frames.push_back(std::move(now));
  }
  return table;
}

}  // namespace myoid::study
