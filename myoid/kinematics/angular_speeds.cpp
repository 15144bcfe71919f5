#include "myoid/kinematics/angular_speeds.h"

#include <algorithm>
#include <utility>

#include <Eigen/LU>

#include "myoid/core/index.h"

namespace myoid::kinematics {
namespace {

/// Returns true for three rotations about x, y and z, each by its own coordinate.
bool turns_about_axes(const model::Joint& joint) {
  for (std::size_t k = 0; k < 3; ++k) {
    const model::TransformAxis& axis = joint.rotation[k];
    if (k >= joint.coordinates.size() || axis.coordinate != joint.coordinates[k] ||
        axis.axis != Vec3::Unit(static_cast<Eigen::Index>(k)))
      return false;
  }
  return true;
}

/// Returns the axes of the three rotations in F: angular velocity = E qdot.
Mat3 axes_in_parent(const Vec3& q) {
  const Mat3 first = Eigen::AngleAxisd(q[0], Vec3::UnitX()).toRotationMatrix();
  const Mat3 second = Eigen::AngleAxisd(q[1], Vec3::UnitY()).toRotationMatrix();
  Mat3 E;
  E << Vec3::UnitX(), first.col(1), first * second.col(2);
  return E;
}

Vec3 angles_of(const model::Joint& joint, const Eigen::Ref<const Eigen::VectorXd>& q) {
  return {q[joint.coordinates[0]], q[joint.coordinates[1]], q[joint.coordinates[2]]};
}

/// Returns the angular acceleration for zero second derivatives of the angles: each axis moves with
/// the rotations before it.
Vec3 carried(const Mat3& E, const Vec3& rates) {
  const Vec3 after_first = rates[0] * E.col(0);
  const Vec3 after_second = after_first + rates[1] * E.col(1);
  return rates[1] * after_first.cross(E.col(1)) + rates[2] * after_second.cross(E.col(2));
}

}  // namespace

std::vector<int> angular_speed_joints(const model::BodyModel& model) {
  std::vector<int> joints;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const model::Joint& joint = model.joints[j];
    for (const char* kind : {"BallJoint", "FreeJoint", "EllipsoidJoint", "ScapulothoracicJoint"})
      if (joint.class_name == kind && turns_about_axes(joint)) joints.push_back(static_cast<int>(j));
  }
  return joints;
}

Eigen::MatrixXd rates_of_speeds(const model::BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& q) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Identity(q.size(), q.size());
  for (const int j : angular_speed_joints(model)) {
    const model::Joint& joint = model.joints[at(j)];
    const Mat3 inverse = axes_in_parent(angles_of(joint, q)).inverse();
    for (Eigen::Index row = 0; row < 3; ++row)
      for (Eigen::Index column = 0; column < 3; ++column)
        N(joint.coordinates[at(row)], joint.coordinates[at(column)]) = inverse(row, column);
  }
  return N;
}

Eigen::VectorXd on_rates(const model::BodyModel& model,
                         const Eigen::Ref<const Eigen::VectorXd>& q,
                         Eigen::VectorXd on_speeds) {
  if (!takes_rates_for_speeds(model)) return on_speeds;
  for (const int j : angular_speed_joints(model)) {
    const model::Joint& joint = model.joints[at(j)];
    const Vec3 forces = axes_in_parent(angles_of(joint, q)).transpose() * angles_of(joint, on_speeds);
    for (Eigen::Index k = 0; k < 3; ++k) on_speeds[joint.coordinates[at(k)]] = forces[k];
  }
  return on_speeds;
}

bool takes_rates_for_speeds(const model::BodyModel& model) {
  return model.compat.rates_for_angular_velocities && !angular_speed_joints(model).empty();
}

JointMotion moved_by_speeds(const model::BodyModel& model, const JointMotion& motion) {
  if (!takes_rates_for_speeds(model)) return motion;
  Eigen::MatrixXd qdot = motion.qdot.values(), qddot = motion.qddot.values();
  for (const int j : angular_speed_joints(model)) {
    const model::Joint& joint = model.joints[at(j)];
    for (Eigen::Index i = 0; i < qdot.rows(); ++i) {
      const Mat3 E = axes_in_parent(angles_of(joint, motion.q.values().row(i).transpose()));
      const Eigen::PartialPivLU<Mat3> solver(E);
      const Vec3 rates = solver.solve(angles_of(joint, qdot.row(i).transpose()));
      const Vec3 second = solver.solve(angles_of(joint, qddot.row(i).transpose()) - carried(E, rates));
      for (Eigen::Index k = 0; k < 3; ++k) {
        qdot(i, joint.coordinates[at(k)]) = rates[k];
        qddot(i, joint.coordinates[at(k)]) = second[k];
      }
    }
  }
  return {motion.q, TimeSeries(motion.qdot.time_s(), motion.qdot.channels(), std::move(qdot)),
          TimeSeries(motion.qddot.time_s(), motion.qddot.channels(), std::move(qddot))};
}

}  // namespace myoid::kinematics
