#include "myoid/simulation/tree_dynamics.h"

namespace myoid::simulation {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

TreeDynamics::TreeDynamics(const model::BodyModel& model)
    : model_(&model), state_(model::make_state(model)) {
  const auto n = static_cast<Eigen::Index>(model.coordinates.size());
  mass_.setZero(n, n);
  gravity_.setZero(n);
  coriolis_.setZero(n);
  rest_.setZero(n);
  composite_mass_.resize(model.bodies.size());
  moment_.resize(model.bodies.size());
  inertia_.resize(model.bodies.size());
  v_origin_.resize(model.coordinates.size());
}

void TreeDynamics::set(const Eigen::Ref<const Eigen::VectorXd>& q,
                       const Eigen::Ref<const Eigen::VectorXd>& qdot) {
  const model::BodyModel& model = *model_;
  // C - gravity; leaves poses and velocities in the state.
  coriolis_ = model::inverse_dynamics(model, q, qdot, rest_, {}, state_);

  potential_ = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::Body& body = model.bodies[b];
    const Mat3& R = state_.X_GB[b].R;
    const Vec3 c = state_.X_GB[b] * body.p_BBcm_B;
    composite_mass_[b] = b == 0 ? 0.0 : body.mass_kg;
    moment_[b] = composite_mass_[b] * c;
    const Mat3 cross = skew(c);
    inertia_[b] =
        b == 0 ? Mat3(Mat3::Zero())
               : Mat3(R * body.I_BBcm_B * R.transpose() - composite_mass_[b] * cross * cross);
    potential_ -= moment_[b].dot(model.gravity_G);
  }
  mass_.setZero();
  for (std::size_t j = model.joints.size(); j-- > 0;) {
    const model::Joint& joint = model.joints[j];
    const std::size_t b = at(joint.child);
    for (const int c : joint.coordinates)
      v_origin_[at(c)] = state_.H_v_G[at(c)] - state_.H_w_G[at(c)].cross(state_.X_GB[b].p);
  }
  for (std::size_t j = model.joints.size(); j-- > 0;) {
    const model::Joint& joint = model.joints[j];
    const std::size_t b = at(joint.child);
    for (const int c : joint.coordinates) {
      const Vec3& w = state_.H_w_G[at(c)];
      const Vec3& v = v_origin_[at(c)];
      const Vec3 momentum = composite_mass_[b] * v + w.cross(moment_[b]);
      const Vec3 angular = moment_[b].cross(v) + inertia_[b] * w;
      gravity_[c] =
          w.dot(moment_[b].cross(model.gravity_G)) + v.dot(composite_mass_[b] * model.gravity_G);
      for (model::BodyIndex up = joint.child; up != 0;) {
        const model::Joint& carrier = model.joints[at(model.joint_of_body[at(up)])];
        for (const int d : carrier.coordinates) {
          mass_(c, d) = mass_(d, c) =
              state_.H_w_G[at(d)].dot(angular) + v_origin_[at(d)].dot(momentum);
        }
        up = carrier.parent;
      }
    }
    const std::size_t parent = at(joint.parent);
    composite_mass_[parent] += composite_mass_[b];
    moment_[parent] += moment_[b];
    inertia_[parent] += inertia_[b];
  }
  coriolis_ += gravity_;
  kinetic_ = 0.5 * qdot.dot(mass_ * qdot);
}

bool TreeDynamics::accelerate(const double* tau,
                              const char* prescribed,
                              double* qddot,
                              double* device) {
  const Eigen::Index n = mass_.rows();
  free_.clear();
  for (int k = 0; k < n; ++k) {
    device[k] = 0.0;
    if (prescribed[k] == 0) free_.push_back(k);
  }
  const auto m = static_cast<Eigen::Index>(free_.size());
  reduced_.resize(m, m);
  rhs_.resize(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const int r = free_[static_cast<std::size_t>(i)];
    rhs_[i] = tau[r] + gravity_[r] - coriolis_[r];
    for (Eigen::Index k = 0; k < n; ++k) {
      if (prescribed[k] != 0) rhs_[i] -= mass_(r, k) * qddot[k];
    }
    for (Eigen::Index j = 0; j < m; ++j)
      reduced_(i, j) = mass_(r, free_[static_cast<std::size_t>(j)]);
  }
  if (m > 0) {
    factor_.compute(reduced_);
    if (factor_.info() != Eigen::Success) return false;
    factor_.solveInPlace(rhs_);
    for (Eigen::Index i = 0; i < m; ++i) qddot[free_[static_cast<std::size_t>(i)]] = rhs_[i];
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    if (prescribed[k] == 0) continue;
    double required = coriolis_[k] - gravity_[k] - tau[k];
    for (Eigen::Index d = 0; d < n; ++d) required += mass_(k, d) * qddot[d];
    device[k] = required;
  }
  return true;
}

}  // namespace myoid::simulation
