#include "myoid/model/kinematic_tree.h"

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/index.h"
#include "myoid/model/bent_rod.h"

namespace myoid::model {
namespace {

void check_size(const BodyModel& model, Eigen::Index size, std::string_view what) {
  if (size != static_cast<Eigen::Index>(model.coordinates.size())) {
    throw InvalidInput(
        fmt::format("{}: {} values for {} coordinates", what, size, model.coordinates.size()));
  }
}

double argument(const TransformAxis& axis, const Eigen::Ref<const Eigen::VectorXd>& q) {
  return axis.coordinate < 0 ? 0.0 : q[axis.coordinate];
}

/// A joint at one posture: X_FM, and each axis turned into F with the function's value and
/// derivatives.
struct JointPosture {
  Pose X_FM;
  std::array<Vec3, 3> axis_F;
  std::array<FunctionValue, 3> angle;
  std::array<FunctionValue, 3> shift;
};

JointPosture posture(const Joint& joint, const Eigen::Ref<const Eigen::VectorXd>& q) {
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

/// Velocity of M in F and the part of its acceleration that does not come from qddot, expressed in
/// F.
struct RelativeMotion {
  Vec3 w = Vec3::Zero(), v = Vec3::Zero(), alpha = Vec3::Zero(), a = Vec3::Zero();
};

/// Angular velocity that is taken to carry axis i: that of the axes before it or, as OpenSim has it
/// (Compat::axes_carried_by_coordinates), of all axes under the first coordinate (for the second)
/// or under any but the third coordinate (for the third).
Vec3 carrying_rate(const Joint& joint,
                   const JointPosture& p,
                   const Eigen::Ref<const Eigen::VectorXd>& qdot,
                   std::size_t i) {
  Vec3 w = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const int c = joint.rotation[k].coordinate;
    if (c < 0) continue;
    const bool counts = i == 1 ? c == joint.coordinates[0]
                               : joint.coordinates.size() < 3 || c != joint.coordinates[2];
    if (counts) w += p.angle[k].first * qdot[c] * p.axis_F[k];
  }
  return w;
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
    // The axis is carried by the rotations before it, whose angular velocity so far is m.w.
    m.alpha +=
        (p.angle[i].second * qdot[c] * qdot[c] + p.angle[i].first * qddot[c]) * p.axis_F[i] +
        rate *
            (by_coordinates && i > 0 ? carrying_rate(joint, p, qdot, i) : m.w).cross(p.axis_F[i]);
    m.w += rate * p.axis_F[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const int c = joint.translation[i].coordinate;
    if (c < 0) continue;
    m.v += p.shift[i].first * qdot[c] * joint.translation[i].axis;
    m.a += (p.shift[i].second * qdot[c] * qdot[c] + p.shift[i].first * qddot[c]) *
           joint.translation[i].axis;
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

}  // namespace

BodyState make_state(const BodyModel& model) {
  const Eigen::Index n = static_cast<Eigen::Index>(model.coordinates.size());
  BodyState state;
  state.q = Eigen::VectorXd::Zero(n);
  state.qdot = Eigen::VectorXd::Zero(n);
  state.X_GB.resize(model.bodies.size());
  state.w_GB.assign(model.bodies.size(), Vec3::Zero());
  state.v_GB.assign(model.bodies.size(), Vec3::Zero());
  state.H_w_G.assign(model.coordinates.size(), Vec3::Zero());
  state.H_v_G.assign(model.coordinates.size(), Vec3::Zero());
  return state;
}

void compute_poses(const BodyModel& model,
                   const Eigen::Ref<const Eigen::VectorXd>& q,
                   BodyState& state) {
  check_size(model, q.size(), "posture");
  state.q = q;
  for (const Joint& joint : model.joints) {
    const JointPosture p = posture(joint, q);
    const Pose X_GF = state.X_GB[at(joint.parent)] * joint.X_PF;
    const Pose X_GM = X_GF * p.X_FM;
    const Pose X_GB = X_GM * joint.X_BM.inverse();
    state.X_GB[at(joint.child)] = X_GB;
    const Vec3 r = X_GB.p - X_GM.p;
    for (const int c : joint.coordinates) state.H_w_G[at(c)] = state.H_v_G[at(c)] = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      if (const int c = joint.rotation[i].coordinate; c >= 0) {
        const Vec3 w_F = p.angle[i].first * p.axis_F[i];
        state.H_w_G[at(c)] += X_GF.R * w_F;
        if (joint.ellipsoid_radii_m)
          state.H_v_G[at(c)] +=
              X_GF.R * joint.ellipsoid_radii_m->cwiseProduct(w_F.cross(p.X_FM.R.col(2)));
        if (joint.rod_length_m) {
          const Vec3 u = p.X_FM.R.col(1);
          state.H_v_G[at(c)] += X_GF.R * bent_rod_velocity(*joint.rod_length_m, u, w_F.cross(u));
        }
      }
      if (const int c = joint.translation[i].coordinate; c >= 0) {
        state.H_v_G[at(c)] += X_GF.R * (p.shift[i].first * joint.translation[i].axis);
      }
    }
    for (const int c : joint.coordinates) state.H_v_G[at(c)] += state.H_w_G[at(c)].cross(r);
  }
}

void compute_velocities(const BodyModel& model,
                        const Eigen::Ref<const Eigen::VectorXd>& qdot,
                        BodyState& state) {
  check_size(model, qdot.size(), "velocity");
  state.qdot = qdot;
  state.w_GB[0].setZero();
  state.v_GB[0].setZero();
  for (const Joint& joint : model.joints) {
    const std::size_t b = at(joint.child);
    const std::size_t parent = at(joint.parent);
    state.w_GB[b] = state.w_GB[parent];
    state.v_GB[b] =
        state.v_GB[parent] + state.w_GB[parent].cross(state.X_GB[b].p - state.X_GB[parent].p);
    for (const int c : joint.coordinates) {
      state.w_GB[b] += qdot[c] * state.H_w_G[at(c)];
      state.v_GB[b] += qdot[c] * state.H_v_G[at(c)];
    }
  }
}

Eigen::Matrix3Xd station_jacobian(const BodyModel& model,
                                  const BodyState& state,
                                  BodyIndex body,
                                  const Vec3& p_BP) {
  Eigen::Matrix3Xd jacobian =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(model.coordinates.size()));
  const Vec3 p_GP = state.X_GB[at(body)] * p_BP;
  for (BodyIndex b = body; b != 0;) {
    const Joint& joint = model.joints[at(model.joint_of_body[at(b)])];
    for (const int c : joint.coordinates) {
      jacobian.col(c) = state.H_v_G[at(c)] + state.H_w_G[at(c)].cross(p_GP - state.X_GB[at(b)].p);
    }
    b = joint.parent;
  }
  return jacobian;
}

Eigen::VectorXd inverse_dynamics(const BodyModel& model,
                                 const Eigen::Ref<const Eigen::VectorXd>& q,
                                 const Eigen::Ref<const Eigen::VectorXd>& qdot,
                                 const Eigen::Ref<const Eigen::VectorXd>& qddot,
                                 const std::vector<BodyWrench>& external,
                                 BodyState& state,
                                 std::vector<BodyWrench>* carried) {
  check_size(model, qddot.size(), "acceleration");
  compute_poses(model, q, state);
  compute_velocities(model, qdot, state);
  const std::size_t count = model.bodies.size();
  // Outward: accelerations, with gravity as an upward acceleration of ground.
  std::vector<Vec3> alpha(count, Vec3::Zero());
  std::vector<Vec3> a(count, -model.gravity_G);
  std::vector<Vec3> force(count, Vec3::Zero());
  std::vector<Vec3> moment(count, Vec3::Zero());  // about the body's origin
  for (const Joint& joint : model.joints) {
    const std::size_t b = at(joint.child);
    const std::size_t parent = at(joint.parent);
    const JointPosture p = posture(joint, q);
    const Pose X_GF = state.X_GB[parent] * joint.X_PF;
    const Vec3 p_GM = X_GF * p.X_FM.p;
    const bool by_coordinates =
        model.compat.axes_carried_by_coordinates && joint.class_name == "CustomJoint";
    const RelativeMotion m = relative_motion(joint, by_coordinates, p, qdot, qddot);
    const Vec3 w_P = state.w_GB[parent];
    const Vec3 rho = p_GM - state.X_GB[parent].p;
    const Vec3 w_rel = X_GF.R * m.w;
    const Vec3 v_rel = X_GF.R * m.v;
    alpha[b] = alpha[parent] + w_P.cross(w_rel) + X_GF.R * m.alpha;
    const Vec3 a_M = a[parent] + alpha[parent].cross(rho) + w_P.cross(w_P.cross(rho)) +
                     2.0 * w_P.cross(v_rel) + X_GF.R * m.a;
    const Vec3 r = state.X_GB[b].p - p_GM;
    const Vec3& w = state.w_GB[b];
    a[b] = a_M + alpha[b].cross(r) + w.cross(w.cross(r));

    const Body& body = model.bodies[b];
    const Mat3& R = state.X_GB[b].R;
    const Vec3 c = R * body.p_BBcm_B;
    const Mat3 inertia = R * body.I_BBcm_B * R.transpose();
    force[b] = body.mass_kg * (a[b] + alpha[b].cross(c) + w.cross(w.cross(c)));
    moment[b] = inertia * alpha[b] + w.cross(inertia * w) + c.cross(force[b]);
  }
  for (const BodyWrench& wrench : external) {
    force[at(wrench.body)] -= wrench.f_G;
    moment[at(wrench.body)] -= wrench.m_G;
  }
  if (carried != nullptr) carried->assign(count, BodyWrench{});
  // Inward: wrenches to the parents, projected on each joint's motions.
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(qddot.size());
  for (std::size_t j = model.joints.size(); j-- > 0;) {
    const Joint& joint = model.joints[j];
    const std::size_t b = at(joint.child);
    for (const int c : joint.coordinates) {
      tau[c] = state.H_w_G[at(c)].dot(moment[b]) + state.H_v_G[at(c)].dot(force[b]);
    }
    if (carried != nullptr) (*carried)[b] = {joint.child, force[b], moment[b]};
    const std::size_t parent = at(joint.parent);
    force[parent] += force[b];
    moment[parent] += moment[b] + (state.X_GB[b].p - state.X_GB[parent].p).cross(force[b]);
  }
  return tau;
}

Eigen::MatrixXd mass_matrix(const BodyModel& model,
                            const Eigen::Ref<const Eigen::VectorXd>& q,
                            BodyState& state) {
  const Eigen::Index n = static_cast<Eigen::Index>(model.coordinates.size());
  BodyModel weightless = model;
  weightless.gravity_G.setZero();
  Eigen::MatrixXd mass(n, n);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    mass.col(k) = inverse_dynamics(weightless, q, rest, Eigen::VectorXd::Unit(n, k), {}, state);
  }
  return mass;
}

}  // namespace myoid::model
