#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// Returns postures that differ from q in the rotations of one joint and pose its child alike, within the ranges of
/// clamped coordinates: a coordinate a whole turn further, and the second set of three angles about axes at right
/// angles (q1 + pi, pi - q2 or -q2, q3 + pi). A search that has met the end of a range may go on from there.
[[nodiscard]] std::vector<Eigen::VectorXd> twin_angles(const body::BodyModel& model,
                                                       const body::Joint& joint,
                                                       const Eigen::VectorXd& q);

/// Returns the coordinates of a joint that has three free angles of its own; nothing for another joint.
[[nodiscard]] std::optional<std::array<int, 3>> free_angles(const body::BodyModel& model, const body::Joint& joint);

/// Returns the value moved by whole turns to the middle of its range.
[[nodiscard]] double turned_to_range(const body::Coordinate& coordinate, double value);

/// Returns true where a clamped coordinate lies at an end of its range, within a millionth of the range.
[[nodiscard]] bool lies_at_end(const body::Coordinate& coordinate, double value);

/// Returns true if an angle that is not clamped lies more than 30 degrees outside its range, and farther than in
/// `from`: the functions of a joint mean nothing there.
[[nodiscard]] bool strays(const body::BodyModel& model, const Eigen::VectorXd& q, const Eigen::VectorXd& from);

/// Returns true if the coordinate turns the joint's child.
[[nodiscard]] bool turns(const body::Joint& joint, int coordinate);

}  // namespace myoid::body
