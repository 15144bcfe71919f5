#include "myoid/body/kinematics/angular_speeds.h"

#include <array>
#include <utility>

#include <Eigen/LU>

#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

/// Returns true for three rotations about x, y and z, each by its own coordinate.
bool turns_about_axes(const body::Joint& joint) {
  for (std::size_t k = 0; k < 3; ++k) {
    const body::TransformAxis& axis = joint.rotation[k];
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

/// Returns the three angles of each of the joints.
std::vector<std::array<int, 3>> angles_of_joints(const body::BodyModel& model) {
  std::vector<std::array<int, 3>> angles;
  for (const int j : angular_speed_joints(model)) {
    const auto& c = model.joints[at(j)].coordinates;
    angles.push_back({c[0], c[1], c[2]});
  }
  return angles;
}

/// Returns the angular acceleration for zero second derivatives of the angles: each axis moves with
/// the rotations before it.
Vec3 carried(const Mat3& E, const Vec3& rates) {
  const Vec3 after_first = rates[0] * E.col(0);
  const Vec3 after_second = after_first + rates[1] * E.col(1);
  return rates[1] * after_first.cross(E.col(1)) + rates[2] * after_second.cross(E.col(2));
}

}  // namespace

std::vector<int> angular_speed_joints(const body::BodyModel& model) {
  std::vector<int> joints;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const body::Joint& joint = model.joints[j];
    for (const char* kind : {"BallJoint", "FreeJoint", "EllipsoidJoint", "ScapulothoracicJoint"})
      if (joint.class_name == kind && turns_about_axes(joint)) joints.push_back(static_cast<int>(j));
  }
  return joints;
}

Eigen::MatrixXd rates_of_speeds(const body::BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& q) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Identity(q.size(), q.size());
  for (const auto& c : angles_of_joints(model)) N(c, c) = axes_in_parent(q(c)).inverse();
  return N;
}

Eigen::VectorXd on_rates(const body::BodyModel& model,
                         const Eigen::Ref<const Eigen::VectorXd>& q,
                         Eigen::VectorXd on_speeds) {
  if (!takes_rates_for_speeds(model)) return on_speeds;
  for (const auto& c : angles_of_joints(model)) {
    const Vec3 forces = on_speeds(c);
    on_speeds(c) = axes_in_parent(q(c)).transpose() * forces;
  }
  return on_speeds;
}

Eigen::VectorXd speeds_of_rates(const body::BodyModel& model,
                                const Eigen::Ref<const Eigen::VectorXd>& q,
                                Eigen::VectorXd qdot) {
  if (!takes_rates_for_speeds(model)) return qdot;
  for (const auto& c : angles_of_joints(model)) {
    const Vec3 rates = qdot(c);
    qdot(c) = axes_in_parent(q(c)) * rates;
  }
  return qdot;
}

bool takes_rates_for_speeds(const body::BodyModel& model) {
  return model.compat.rates_for_angular_velocities && !angular_speed_joints(model).empty();
}

JointMotion moved_by_speeds(const body::BodyModel& model, const JointMotion& motion) {
  if (!takes_rates_for_speeds(model)) return motion;
  Eigen::MatrixXd qdot = motion.qdot.values(), qddot = motion.qddot.values();
  for (const auto& c : angles_of_joints(model)) {
    for (Eigen::Index i = 0; i < qdot.rows(); ++i) {
      const Mat3 E = axes_in_parent(motion.q.values()(i, c).transpose());
      const Eigen::PartialPivLU<Mat3> solver(E);
      const Vec3 rates = solver.solve(Vec3(qdot(i, c).transpose()));
      const Vec3 second = solver.solve(Vec3(qddot(i, c).transpose()) - carried(E, rates));
      qdot(i, c) = rates.transpose();
      qddot(i, c) = second.transpose();
    }
  }
  return {motion.q, TimeSeries(motion.qdot.time_s(), motion.qdot.channels(), std::move(qdot)),
          TimeSeries(motion.qddot.time_s(), motion.qddot.channels(), std::move(qddot))};
}

}  // namespace myoid::body
