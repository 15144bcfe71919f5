#include "myoid/body/kinematics/joint_angles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "myoid/body/model/joint_posture.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

constexpr double kAtEnd = 1e-6;  ///< Of the range: nearer to an end lies at it.

}  // namespace

double turned_to_range(const body::Coordinate& coordinate, double value) {
  const double middle = 0.5 * (coordinate.lower + coordinate.upper);
  return value + 2.0 * kPi * std::round((middle - value) / (2.0 * kPi));
}

std::optional<std::array<int, 3>> free_angles(const body::BodyModel& model, const body::Joint& joint) {
  std::array<int, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = joint.rotation[i].coordinate;
    if (c[i] < 0 || model.is_constrained(c[i])) return std::nullopt;
  }
  if (c[0] == c[1] || c[1] == c[2] || c[0] == c[2]) return std::nullopt;
  return c;
}

bool lies_at_end(const body::Coordinate& coordinate, double value) {
  const double width = coordinate.upper - coordinate.lower;
  return coordinate.clamped && std::min(value - coordinate.lower, coordinate.upper - value) < kAtEnd * width;
}

bool strays(const body::BodyModel& model, const Eigen::VectorXd& q, const Eigen::VectorXd& from) {
  constexpr double kStray_rad = kPi / 6.0;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    const body::Coordinate& of = model.coordinates[c];
    if (of.motion != body::MotionType::rotational || of.upper <= of.lower || model.is_constrained(static_cast<int>(c)))
      continue;
    const auto outside = [&](double x) { return std::max({0.0, of.lower - x, x - of.upper}); };
    const auto i = static_cast<Eigen::Index>(c);
    if (outside(q[i]) > std::max(kStray_rad, outside(from[i]) + 1e-6)) return true;
  }
  return false;
}

bool turns(const body::Joint& joint, int coordinate) {
  return std::any_of(joint.rotation.begin(), joint.rotation.end(),
                     [&](const auto& axis) { return axis.coordinate == coordinate; });
}

std::vector<Eigen::VectorXd> twin_angles(const body::BodyModel& model,
                                         const body::Joint& joint,
                                         const Eigen::VectorXd& q) {
  std::vector<Eigen::VectorXd> twins;
  const Mat3 here = body::joint_posture(joint, q).X_FM.R;
  const auto add = [&](Eigen::VectorXd twin) {
    for (const body::TransformAxis& axis : joint.rotation) {
      if (axis.coordinate < 0) continue;
      const body::Coordinate& c = model.coordinates[at(axis.coordinate)];
      if (c.clamped && (twin[axis.coordinate] < c.lower || twin[axis.coordinate] > c.upper)) return;
    }
    if ((body::joint_posture(joint, twin).X_FM.R - here).cwiseAbs().maxCoeff() < 1e-6) twins.push_back(std::move(twin));
  };
  for (const body::TransformAxis& axis : joint.rotation) {
    const int c = axis.coordinate;
    if (c < 0 || model.is_constrained(c)) continue;
    // From one end of a range to beyond the other, where the range is a turn.
    for (const double turn : {-2.0 * kPi, 2.0 * kPi}) {
      const body::Coordinate& of = model.coordinates[at(c)];
      if (!lies_at_end(of, q[c])) continue;
      Eigen::VectorXd twin = q;
      twin[c] = std::clamp(q[c] + turn, of.lower, of.upper);
      add(std::move(twin));
    }
  }
  const auto angles = free_angles(model, joint);
  if (!angles) return twins;
  const std::array<int, 3>& c = *angles;
  for (const double middle : {kPi - q[c[1]], -q[c[1]]}) {
    Eigen::VectorXd twin = q;
    twin[c[0]] = turned_to_range(model.coordinates[at(c[0])], q[c[0]] + kPi);
    twin[c[1]] = turned_to_range(model.coordinates[at(c[1])], middle);
    twin[c[2]] = turned_to_range(model.coordinates[at(c[2])], q[c[2]] + kPi);
    add(std::move(twin));
  }
  return twins;
}

}  // namespace myoid::body
