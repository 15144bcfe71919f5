#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/kinematic_tree.h"

namespace myoid::body {

/// Returns two unit vectors at right angles to u and to each other: a LineConstraint stops motion along them.
[[nodiscard]] std::array<Vec3, 2> directions_across(const Vec3& u);

/// Conditions on the accelerations at one state: A qddot = b. The rows are those of `constraint_jacobian` (couplers,
/// then the other constraints), then one for each locked or prescribed coordinate.
struct AccelerationConstraints {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};

/// Differentiates the constraints twice with respect to time. b holds the terms of the rates and,
/// for a prescribed coordinate, the second derivative of its function at `time_s`. `compute_poses`
/// and `compute_velocities` must have been called on `state`.
[[nodiscard]] AccelerationConstraints acceleration_constraints(const BodyModel& model,
                                                               const BodyState& state,
                                                               double time_s);

/// Adds the wrenches on bodies that the constraints exert when `multipliers` belong to the rows of
/// `acceleration_constraints`. Couplers, polynomials of coordinates, locks and prescribed
/// coordinates exert none, because their forces act along coordinates.
void append_constraint_wrenches(const BodyModel& model,
                                const BodyState& state,
                                const Eigen::VectorXd& multipliers,
                                std::vector<BodyWrench>& wrenches);

}  // namespace myoid::body
