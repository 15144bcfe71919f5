#include "myoid/body/dynamics/ground_support.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/dynamics/joint_capacity.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// The free translation along gravity of a joint to the ground.
struct Root {
  const body::Coordinate* coordinate;
  double weight_n;  ///< Weight of all bodies.

  /// Returns the column of its generalized force; empty if there is none.
  [[nodiscard]] std::optional<Eigen::Index> column_in(const TimeSeries& generalized_forces) const {
    return generalized_forces.find(generalized_force_name(*coordinate));
  }
};

/// Returns the translation that is nearest to gravity; empty if there is none, or no weight.
std::optional<Root> root_of(const body::BodyModel& model) {
  const double g = model.gravity_G.norm();
  if (!(g > 0.0)) return std::nullopt;
  const Vec3 down = model.gravity_G / g;
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  Root root{nullptr, 0.0};
  double best = 0.7;  // cosine of the axis with gravity: nearer than 45 degrees
  for (const body::Joint& joint : model.joints) {
    if (joint.parent != 0) continue;
    for (const int c : joint.coordinates) {
      const body::Coordinate& coordinate = model.coordinates[at(c)];
      if (coordinate.motion != body::MotionType::translational || model.is_constrained(c)) continue;
      const double along = std::abs(state.H_v_G[at(c)].dot(down));
      if (along <= best) continue;
      best = along;
      root.coordinate = &coordinate;
    }
  }
  for (const body::Body& body : model.bodies) root.weight_n += g * body.mass_kg;
  if (root.coordinate == nullptr || !(root.weight_n > 0.0)) return std::nullopt;
  return root;
}

}  // namespace

std::string UnsupportedWeight::sentence(const std::string& given_by) const {
  if (given_by.empty())
    return fmt::format(
        "the measured forces do not carry the body: {} has to bear {:.0f} N, {:.0f} % of the model's weight ({:.0f} "
        "N); "
        "are the forces complete, of both feet and of all times, and in N?",
        coordinate, force_n, 100.0 * force_n / weight_n, weight_n);
  return fmt::format(
      "nothing carries the body: {} has to bear {:.0f} N, {:.0f} % of the model's weight ({:.0f} N); the torques "
      "between the ground and the trunk lack the ground reaction: give it by {}",
      coordinate, force_n, 100.0 * force_n / weight_n, weight_n, given_by);
}

std::optional<UnsupportedWeight> unsupported_weight(const body::BodyModel& model,
                                                    const TimeSeries& generalized_forces) {
  constexpr double kMost = 0.5;
  const auto root = root_of(model);
  const auto column = root ? root->column_in(generalized_forces) : std::nullopt;
  if (!column || generalized_forces.sample_count() == 0) return std::nullopt;
  const double force = std::abs(generalized_forces.values().col(*column).mean());
  if (!(force >= kMost * root->weight_n)) return std::nullopt;
  return UnsupportedWeight{root->coordinate->name, force, root->weight_n};
}

std::optional<UnsupportedWeight> unsupported_weight(const body::BodyModel& model) {
  const auto root = root_of(model);
  if (!root) return std::nullopt;
  return UnsupportedWeight{root->coordinate->name, root->weight_n, root->weight_n};
}

bool WrongSupport::is_misdirected() const { return force_n.norm() >= kCarriedWeight * weight_n; }

std::string WrongSupport::sentence() const {
  struct ForceUnit {
    const char* name;
    double newtons;
  };
  const std::string mean = fmt::format(
      "mean vertical force while they act {:.4g} N, {:.3g} times the model's weight ({:.0f} N), expected "
      "about +1 of a person who stands or walks",
      up.dot(force_n), upward(), weight_n);
  if (upward() <= -kCarriedWeight)
    return fmt::format(
        "the forces pull the body downwards ({}): reverse their sign; they must be those of the ground on "
        "the body, upwards in stance",
        mean);
  if (is_misdirected())
    return fmt::format(
        "the forces push the body sideways, along ({:.2g}, {:.2g}, {:.2g}) with ({:.2g}, {:.2g}, {:.2g}) "
        "up ({}): turn the forces and their points to the model's axes",
        force_n.x() / weight_n, force_n.y() / weight_n, force_n.z() / weight_n, up.x(), up.y(), up.z(), mean);
  for (const ForceUnit& unit : {ForceUnit{"kgf", 9.80665}, {"lbf", 4.4482}, {"kN", 1000.0}}) {
    const double right = unit.newtons * upward();  // half to one and a half of the weight, as in stance
    if (right > 0.7 && right < 1.4)
      return fmt::format(
          "the forces carry {:.2g} % of the body's weight ({}): are they in {}? Then multiply them by "
          "{:.4g}; they must be in N",
          100.0 * upward(), mean, unit.name, unit.newtons);
  }
  return fmt::format(
      "the forces carry {:.2g} % of the body's weight ({}): is a plate or a foot missing, or are they not "
      "in N? If the person sits, leans or hangs, nothing is wrong",
      100.0 * upward(), mean);
}

std::optional<WrongSupport> wrong_support(const body::BodyModel& model,
                                          const ExternalLoads& loads,
                                          const Eigen::VectorXd& time_s) {
  constexpr double kActs = 0.2;  // of the largest force
  const auto root = root_of(model);
  if (!root || time_s.size() == 0) return std::nullopt;
  const auto is_on_ground = [](const ExternalForce& f) {
    return f.body != 0 && f.force_frame == 0 && f.point_frame == 0 && f.force && f.point;
  };
  if (std::ranges::none_of(loads.forces, is_on_ground)) return std::nullopt;
  Eigen::MatrixX3d sum_n = Eigen::MatrixX3d::Zero(time_s.size(), 3);
  for (const ExternalForce& force : loads.forces) {
    if (!is_on_ground(force)) continue;
    for (Eigen::Index i = 0; i < time_s.size(); ++i)
      sum_n.row(i) += force.force->at(loads.data_time_s(time_s[i])).transpose();
  }
  const Eigen::VectorXd size = sum_n.rowwise().norm();
  WrongSupport found{.up = -model.gravity_G.normalized(), .weight_n = root->weight_n};
  double count = 0.0;
  for (Eigen::Index i = 0; i < size.size(); ++i) {
    if (size[i] < kActs * size.maxCoeff()) continue;
    found.force_n += sum_n.row(i).transpose();
    count += 1.0;
  }
  found.force_n /= count;
  if (found.upward() >= kCarriedWeight) return std::nullopt;
  return found;
}

std::string UncarriedTime::sentence() const {
  std::vector<std::string> times;
  for (const Stretch& s : stretches) times.push_back(fmt::format("{:.4g} to {:.4g} s", s.begin_s, s.end_s));
  return fmt::format(
      "no measured force carries the body in {:.0f} % of the trial ({}): {} has to bear up to {:.0f} N of a weight of "
      "{:.0f} N; was a foot beside the plates, or a hand on a rail? The torques of the legs are wrong there, so that "
      "those times are not fitted; start_s and end_s leave them out altogether",
      100.0 * share, fmt::join(times, ", "), coordinate, force_n, weight_n);
}

std::optional<UncarriedTime> uncarried_time(const body::BodyModel& model, const TimeSeries& generalized_forces) {
  constexpr double kUncarried = 0.5;  // of the weight
  constexpr double kBriefest_s = 0.05;
  constexpr double kThroughout = 0.9;
  const auto root = root_of(model);
  const auto column = root ? root->column_in(generalized_forces) : std::nullopt;
  const Eigen::VectorXd& t = generalized_forces.time_s();
  if (!column || t.size() < 2) return std::nullopt;
  const Eigen::VectorXd force = generalized_forces.values().col(*column).cwiseAbs();
  UncarriedTime found{.coordinate = root->coordinate->name, .weight_n = root->weight_n};
  const auto affected = [&](Eigen::Index i) { return force[i] >= kAffectedWeight * root->weight_n; };
  double sum_s = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (!affected(i)) continue;
    const Eigen::Index first = i;
    Eigen::Index half_first = -1, half_last = -1;
    for (; i < t.size() && affected(i); ++i) {
      if (force[i] < kUncarried * root->weight_n) continue;
      if (half_first < 0) half_first = i;
      half_last = i;
    }
    if (half_first < 0 || t[half_last] - t[half_first] < kBriefest_s) continue;
    found.stretches.push_back({t[first], t[i - 1]});
    found.force_n = std::max(found.force_n, force.segment(first, i - first).maxCoeff());
    sum_s += t[i - 1] - t[first];
  }
  found.share = sum_s / (t[t.size() - 1] - t[0]);
  if (found.stretches.empty() || found.share > kThroughout) return std::nullopt;
  return found;
}

bool bears_the_body(const body::BodyModel& model,
                    const std::string& coordinate,
                    const Eigen::VectorXd& q,
                    double body_mass_kg) {
  // Head, arms and trunk are 0.68 of a person's mass (Winter 2009): a standing model has more.
  constexpr double kMostOfABody = 0.75;
  constexpr double kGenericBody_kg = 75.0;  // if the person's mass is not stated, or is larger
  double mass = 0.0;
  for (const body::Body& body : model.bodies) mass += body.mass_kg;
  // A stated mass that is too large takes the ground from no model.
  if (mass < kMostOfABody * (body_mass_kg > 0.0 ? std::min(body_mass_kg, kGenericBody_kg) : kGenericBody_kg))
    return false;
  const double g = model.gravity_G.norm();
  if (!(g > 0.0)) return false;
  const Vec3 up = -model.gravity_G / g;
  const int joint = model.coordinates[at(model.coordinate_index(coordinate))].joint;
  const std::vector<bool> moved = moved_bodies(model, joint);
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, q, state);
  double own = std::numeric_limits<double>::infinity();
  double others = own;
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    const double height = up.dot(state.X_GB[b].p);
    (moved[b] ? own : others) = std::min(moved[b] ? own : others, height);
  }
  // The other leg's foot is about as low.
  constexpr double kAsLow_m = 0.15;
  return own < others + kAsLow_m;
}

bool stands(const body::BodyModel& model, const Eigen::VectorXd& q) {
  return std::any_of(model.coordinates.begin(), model.coordinates.end(), [&](const body::Coordinate& c) {
    return c.motion != body::MotionType::translational && model.joints[at(c.joint)].parent != 0 &&
           bears_the_body(model, c.name, q, 0.0);
  });
}

}  // namespace myoid::body
