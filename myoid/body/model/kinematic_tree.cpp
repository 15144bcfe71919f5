#include "myoid/body/model/kinematic_tree.h"

#include <fmt/format.h>

#include "myoid/body/model/bent_rod.h"
#include "myoid/body/model/body_accelerations.h"
#include "myoid/body/model/joint_posture.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

void check_size(const BodyModel& model, Eigen::Index size, std::string_view what) {
  if (size != static_cast<Eigen::Index>(model.coordinates.size())) {
    throw InvalidInput(fmt::format("{}: {} values for {} coordinates", what, size, model.coordinates.size()));
  }
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

void compute_poses(const BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& q, BodyState& state) {
  check_size(model, q.size(), "posture");
  state.q = q;
  for (const Joint& joint : model.joints) {
    const JointPosture p = joint_posture(joint, q);
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
          state.H_v_G[at(c)] += X_GF.R * joint.ellipsoid_radii_m->cwiseProduct(w_F.cross(p.X_FM.R.col(2)));
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

void compute_velocities(const BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& qdot, BodyState& state) {
  check_size(model, qdot.size(), "velocity");
  state.qdot = qdot;
  state.w_GB[0].setZero();
  state.v_GB[0].setZero();
  for (const Joint& joint : model.joints) {
    const std::size_t b = at(joint.child);
    const std::size_t parent = at(joint.parent);
    state.w_GB[b] = state.w_GB[parent];
    state.v_GB[b] = state.v_GB[parent] + state.w_GB[parent].cross(state.X_GB[b].p - state.X_GB[parent].p);
    for (const int c : joint.coordinates) {
      state.w_GB[b] += qdot[c] * state.H_w_G[at(c)];
      state.v_GB[b] += qdot[c] * state.H_v_G[at(c)];
    }
  }
}

Eigen::Matrix3Xd station_jacobian(const BodyModel& model, const BodyState& state, BodyIndex body, const Vec3& p_BP) {
  Eigen::Matrix3Xd jacobian = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(model.coordinates.size()));
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

Eigen::Matrix3Xd angular_jacobian(const BodyModel& model, const BodyState& state, BodyIndex body) {
  Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(model.coordinates.size()));
  for (BodyIndex b = body; b != 0;) {
    const Joint& joint = model.joints[at(model.joint_of_body[at(b)])];
    for (const int c : joint.coordinates) J.col(c) = state.H_w_G[at(c)];
    b = joint.parent;
  }
  return J;
}

Vec3 point_velocity(const BodyState& state, BodyIndex body, const Vec3& p_G) {
  return state.v_GB[at(body)] + state.w_GB[at(body)].cross(p_G - state.X_GB[at(body)].p);
}

BodyWrench wrench_at(const BodyState& state, BodyIndex body, const Vec3& p_G, const Vec3& f_G) {
  return {body, f_G, (p_G - state.X_GB[at(body)].p).cross(f_G)};
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
  // Gravity acts as an upward acceleration of ground.
  BodyAccelerations motion;
  compute_accelerations(model, qddot, state, motion, -model.gravity_G);
  std::vector<Vec3> force(count, Vec3::Zero());
  std::vector<Vec3> moment(count, Vec3::Zero());  // about the body's origin
  for (const Joint& joint : model.joints) {
    const std::size_t b = at(joint.child);
    const Vec3& w = state.w_GB[b];
    const Body& body = model.bodies[b];
    const Mat3& R = state.X_GB[b].R;
    const Vec3 c = R * body.p_BBcm_B;
    const Mat3 inertia = R * body.I_BBcm_B * R.transpose();
    const Vec3& alpha = motion.alpha_GB[b];
    force[b] = body.mass_kg * (motion.a_GB[b] + alpha.cross(c) + w.cross(w.cross(c)));
    moment[b] = inertia * alpha + w.cross(inertia * w) + c.cross(force[b]);
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

Eigen::MatrixXd mass_matrix(const BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& q, BodyState& state) {
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

}  // namespace myoid::body
