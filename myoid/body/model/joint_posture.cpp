#include "myoid/body/model/joint_posture.h"

#include "myoid/body/model/bent_rod.h"

namespace myoid::body {
namespace {

double argument(const TransformAxis& axis, const Eigen::Ref<const Eigen::VectorXd>& q) {
  return axis.coordinate < 0 ? 0.0 : q[axis.coordinate];
}

/// Returns the angular velocity that OpenSim assumes to carry axis i
/// (Compat::axes_carried_by_coordinates): of all axes of the first coordinate for the second axis,
/// of all axes but the third coordinate's for the third axis. In truth the axes before it carry it.
Vec3 carrying_rate(const Joint& joint,
                   const JointPosture& p,
                   const Eigen::Ref<const Eigen::VectorXd>& qdot,
                   std::size_t i) {
  Vec3 w = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const int c = joint.rotation[k].coordinate;
    if (c < 0) continue;
    const bool counts = i == 1 ? c == joint.coordinates[0] : joint.coordinates.size() < 3 || c != joint.coordinates[2];
    if (counts) w += p.angle[k].first * qdot[c] * p.axis_F[k];
  }
  return w;
}

}  // namespace

JointPosture joint_posture(const Joint& joint, const Eigen::Ref<const Eigen::VectorXd>& q) {
  JointPosture p;
  for (std::size_t i = 0; i < 3; ++i) {
    const TransformAxis& axis = joint.rotation[i];
    p.angle[i] = evaluate(axis.function, argument(axis, q));
    p.axis_F[i] = p.X_FM.R * axis.axis;
    if (p.angle[i].value != 0.0)
      p.X_FM.R = p.X_FM.R * Eigen::AngleAxisd(p.angle[i].value, axis.axis).toRotationMatrix();
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const TransformAxis& axis = joint.translation[i];
    p.shift[i] = evaluate(axis.function, argument(axis, q));
    p.X_FM.p += p.shift[i].value * axis.axis;
  }
  if (joint.ellipsoid_radii_m) p.X_FM.p += joint.ellipsoid_radii_m->cwiseProduct(p.X_FM.R.col(2));
  if (joint.rod_length_m) p.X_FM.p += bent_rod_end(*joint.rod_length_m, p.X_FM.R.col(1));
  return p;
}

RelativeMotion relative_motion(const Joint& joint,
                               bool by_coordinates,
                               const JointPosture& p,
                               const Eigen::Ref<const Eigen::VectorXd>& qdot,
                               const Eigen::Ref<const Eigen::VectorXd>& qddot) {
  RelativeMotion m;
  for (std::size_t i = 0; i < 3; ++i) {
    const int c = joint.rotation[i].coordinate;
    if (c < 0) continue;
    const double rate = p.angle[i].first * qdot[c];
    // The axis moves with the rotations before it, whose angular velocity is m.w.
    m.alpha += (p.angle[i].second * qdot[c] * qdot[c] + p.angle[i].first * qddot[c]) * p.axis_F[i] +
               rate * (by_coordinates && i > 0 ? carrying_rate(joint, p, qdot, i) : m.w).cross(p.axis_F[i]);
    m.w += rate * p.axis_F[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const int c = joint.translation[i].coordinate;
    if (c < 0) continue;
    m.v += p.shift[i].first * qdot[c] * joint.translation[i].axis;
    m.a += (p.shift[i].second * qdot[c] * qdot[c] + p.shift[i].first * qddot[c]) * joint.translation[i].axis;
  }
  if (joint.ellipsoid_radii_m) {
    const Vec3 up = p.X_FM.R.col(2);
    m.v += joint.ellipsoid_radii_m->cwiseProduct(m.w.cross(up));
    m.a += joint.ellipsoid_radii_m->cwiseProduct(m.alpha.cross(up) + m.w.cross(m.w.cross(up)));
  }
  if (joint.rod_length_m) {
    const Vec3 u = p.X_FM.R.col(1);
    const Vec3 du = m.w.cross(u);
    m.v += bent_rod_velocity(*joint.rod_length_m, u, du);
    m.a += bent_rod_acceleration(*joint.rod_length_m, u, du, m.alpha.cross(u) + m.w.cross(du));
  }
  return m;
}

}  // namespace myoid::body
