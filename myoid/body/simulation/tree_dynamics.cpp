#include "myoid/body/simulation/tree_dynamics.h"

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {

TreeDynamics::TreeDynamics(const body::BodyModel& model) : model_(&model), state_(body::make_state(model)) {
  const auto n = static_cast<Eigen::Index>(model.coordinates.size());
  mass_.setZero(n, n);
  gravity_.setZero(n);
  coriolis_.setZero(n);
  rest_.setZero(n);
  composites_.resize(model.bodies.size());
  v_origin_.resize(model.coordinates.size());
  reduced_.bias.setZero(n);
  reduced_.balance.setZero(n);
  dependent_.assign(model.coordinates.size(), 0);
  for (const body::CoordinateCoupler& c : model.couplers) dependent_[at(c.dependent)] = 1;
  coupled_.resize(model.couplers.size());
  std::vector<char> known(dependent_.size());
  for (std::size_t k = 0; k < known.size(); ++k) known[k] = dependent_[k] == 0 ? 1 : 0;
  for (std::size_t before = 1; couplers_.size() < model.couplers.size() && before != 0;) {
    before = 0;
    for (std::size_t c = 0; c < model.couplers.size(); ++c) {
      const body::CoordinateCoupler& coupler = model.couplers[c];
      if (known[at(coupler.dependent)] != 0 || known[at(coupler.independent)] == 0) continue;
      known[at(coupler.dependent)] = 1;
      couplers_.push_back(c);
      ++before;
    }
  }
  if (couplers_.size() < model.couplers.size())
    throw ModelError("couplers of coordinates depend on each other in a circle");
}

void TreeDynamics::set(const Eigen::Ref<const Eigen::VectorXd>& q, const Eigen::Ref<const Eigen::VectorXd>& qdot) {
  const body::BodyModel& model = *model_;
  q_ = q;
  qdot_ = qdot;
  for (const std::size_t c : couplers_) {
    const body::CoordinateCoupler& coupler = model.couplers[c];
    coupled_[c] = body::evaluate(coupler.function, q_[coupler.independent]);
    q_[coupler.dependent] = coupled_[c].value;
    qdot_[coupler.dependent] = coupled_[c].first * qdot_[coupler.independent];
  }
  // C - gravity; sets poses and velocities in the state.
  coriolis_ = body::inverse_dynamics(model, q_, qdot_, rest_, {}, state_);
  take_bodies();
  take_mass_matrix();
  coriolis_ += gravity_;
  kinetic_ = 0.5 * qdot_.dot(mass_ * qdot_);
}

void TreeDynamics::take_bodies() {
  const body::BodyModel& model = *model_;
  potential_ = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    const Mat3& R = state_.X_GB[b].R;
    const Vec3 c = state_.X_GB[b] * body.p_BBcm_B;
    composites_[b].mass_kg = b == 0 ? 0.0 : body.mass_kg;
    composites_[b].moment_kgm = composites_[b].mass_kg * c;
    const Mat3 cross = skew(c);
    composites_[b].inertia_kgm2 =
        b == 0 ? Mat3(Mat3::Zero()) : Mat3(R * body.I_BBcm_B * R.transpose() - composites_[b].mass_kg * cross * cross);
    potential_ -= composites_[b].moment_kgm.dot(model.gravity_G);
  }
}

void TreeDynamics::take_mass_matrix() {
  const body::BodyModel& model = *model_;
  mass_.setZero();
  for (std::size_t j = model.joints.size(); j-- > 0;) {
    const body::Joint& joint = model.joints[j];
    const std::size_t b = at(joint.child);
    for (const int c : joint.coordinates)
      v_origin_[at(c)] = state_.H_v_G[at(c)] - state_.H_w_G[at(c)].cross(state_.X_GB[b].p);
  }
  for (std::size_t j = model.joints.size(); j-- > 0;) {
    const body::Joint& joint = model.joints[j];
    const std::size_t b = at(joint.child);
    for (const int c : joint.coordinates) {
      const Vec3& w = state_.H_w_G[at(c)];
      const Vec3& v = v_origin_[at(c)];
      const Vec3 momentum = composites_[b].mass_kg * v + w.cross(composites_[b].moment_kgm);
      const Vec3 angular = composites_[b].moment_kgm.cross(v) + composites_[b].inertia_kgm2 * w;
      gravity_[c] =
          w.dot(composites_[b].moment_kgm.cross(model.gravity_G)) + v.dot(composites_[b].mass_kg * model.gravity_G);
      for (body::BodyIndex up = joint.child; up != 0;) {
        const body::Joint& carrier = model.joints[at(model.joint_of_body[at(up)])];
        for (const int d : carrier.coordinates) {
          mass_(c, d) = mass_(d, c) = state_.H_w_G[at(d)].dot(angular) + v_origin_[at(d)].dot(momentum);
        }
        up = carrier.parent;
      }
    }
    const std::size_t parent = at(joint.parent);
    composites_[parent].mass_kg += composites_[b].mass_kg;
    composites_[parent].moment_kgm += composites_[b].moment_kgm;
    composites_[parent].inertia_kgm2 += composites_[b].inertia_kgm2;
  }
}

void TreeDynamics::add(const body::BodyWrench& wrench, Eigen::VectorXd& tau) const {
  const Vec3 about_ground = wrench.m_G + state_.X_GB[at(wrench.body)].p.cross(wrench.f_G);
  for (body::BodyIndex up = wrench.body; up != 0;) {
    const body::Joint& carrier = model_->joints[at(model_->joint_of_body[at(up)])];
    for (const int d : carrier.coordinates)
      tau[d] += state_.H_w_G[at(d)].dot(about_ground) + v_origin_[at(d)].dot(wrench.f_G);
    up = carrier.parent;
  }
}

bool TreeDynamics::accelerate(const double* tau, const char* prescribed, double* qddot, double* device) {
  const body::BodyModel& model = *model_;
  const Eigen::Index n = mass_.rows();
  reduced_.free.clear();
  for (int k = 0; k < n; ++k) {
    device[k] = 0.0;
    const bool depends = dependent_[at(k)] != 0;
    reduced_.bias[k] = prescribed[k] != 0 && !depends ? qddot[k] : 0.0;
    if (prescribed[k] == 0 && !depends) reduced_.free.push_back(k);
  }
  const auto m = static_cast<Eigen::Index>(reduced_.free.size());
  reduced_.jacobian.setZero(n, m);
  for (Eigen::Index j = 0; j < m; ++j) reduced_.jacobian(reduced_.free[static_cast<std::size_t>(j)], j) = 1.0;
  for (const std::size_t c : couplers_) {
    const body::CoordinateCoupler& coupler = model.couplers[c];
    const double rate = qdot_[coupler.independent];
    reduced_.bias[coupler.dependent] =
        coupled_[c].second * rate * rate + coupled_[c].first * reduced_.bias[coupler.independent];
    reduced_.jacobian.row(coupler.dependent) = coupled_[c].first * reduced_.jacobian.row(coupler.independent);
  }
  const Eigen::Map<const Eigen::VectorXd> given(tau, n);
  Eigen::Map<Eigen::VectorXd> result(qddot, n);
  reduced_.balance = given + gravity_ - coriolis_;
  reduced_.balance.noalias() -= mass_ * reduced_.bias;
  result = reduced_.bias;
  if (m > 0) {
    reduced_.mass_jacobian.noalias() = mass_ * reduced_.jacobian;
    reduced_.mass.noalias() = reduced_.jacobian.transpose() * reduced_.mass_jacobian;
    reduced_.rhs.noalias() = reduced_.jacobian.transpose() * reduced_.balance;
    reduced_.factor.compute(reduced_.mass);
    if (reduced_.factor.info() != Eigen::Success) return false;
    reduced_.factor.solveInPlace(reduced_.rhs);
    result.noalias() += reduced_.jacobian * reduced_.rhs;
    reduced_.balance.noalias() -= reduced_.mass_jacobian * reduced_.rhs;
  }
  // The rest acts on prescribed coordinates, also through the couplers.
  for (std::size_t c = couplers_.size(); c-- > 0;) {
    const body::CoordinateCoupler& coupler = model.couplers[couplers_[c]];
    reduced_.balance[coupler.independent] += coupled_[couplers_[c]].first * reduced_.balance[coupler.dependent];
  }
  for (int k = 0; k < n; ++k) {
    if (prescribed[k] != 0 && dependent_[at(k)] == 0) device[k] = -reduced_.balance[k];
  }
  return true;
}

}  // namespace myoid::body
