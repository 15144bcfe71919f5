#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// Returns the joints of the classes below that are not reversed.
///
/// OpenSim moves Ball-, Free-, Ellipsoid- and ScapulothoracicJoints by speeds u, the angular
/// velocity of M in F, expressed in F, and its tools set u to the rates of the coordinates. So the
/// bodies move by qdot = N(q) u, where N^-1 has the axes of the three rotations as its columns.
/// Generalized forces and moment arms belong to u: N^T times the ones that belong to the rates.
[[nodiscard]] std::vector<int> angular_speed_joints(const body::BodyModel& model);

/// Returns N(q) over all coordinates, with the unit matrix for coordinates of other joints. Not
/// finite if the second rotation is a right angle.
[[nodiscard]] Eigen::MatrixXd rates_of_speeds(const body::BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& q);

/// Returns the speeds of OpenSim's model that moves with these rates: N^-1 qdot if takes_rates_for_speeds, else `qdot`.
[[nodiscard]] Eigen::VectorXd speeds_of_rates(const body::BodyModel& model,
                                              const Eigen::Ref<const Eigen::VectorXd>& q,
                                              Eigen::VectorXd qdot);

/// Converts generalized forces on the speeds (of actuators and springs on a coordinate) to forces
/// on the coordinates' rates: N^-T times the forces if takes_rates_for_speeds, else unchanged.
[[nodiscard]] Eigen::VectorXd on_rates(const body::BodyModel& model,
                                       const Eigen::Ref<const Eigen::VectorXd>& q,
                                       Eigen::VectorXd on_speeds);

/// Returns true if the model has such joints and behaves as OpenSim's (Compat).
[[nodiscard]] bool takes_rates_for_speeds(const body::BodyModel& model);

/// Returns the motion of OpenSim's model when its speeds and their derivatives are set to the rates of `motion`: q,
/// qdot = N u, qddot = N du/dt + dN/dt u. Returns `motion` unchanged unless takes_rates_for_speeds.
[[nodiscard]] JointMotion moved_by_speeds(const body::BodyModel& model, const JointMotion& motion);

}  // namespace myoid::body
