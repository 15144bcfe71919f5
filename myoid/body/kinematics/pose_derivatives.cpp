// The derivatives of the objective of PoseFit.
#include <algorithm>

#include "myoid/body/kinematics/pose_fit.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {

void PoseFit::update_gains(const Eigen::VectorXd& q) {
  for (std::size_t c = 0; c < reduced_.size(); ++c) {
    double gain = reduced_[c] >= 0 ? 1.0 : 0.0;
    auto i = static_cast<int>(c);
    for (std::size_t step = 0; step < reduced_.size() && coupler_of_[at(i)] >= 0; ++step) {
      const body::CoordinateCoupler& coupler = model_.couplers[at(coupler_of_[at(i)])];
      gain *= evaluate(coupler.function, q[coupler.independent]).first;
      i = coupler.independent;
    }
    gain_[static_cast<Eigen::Index>(c)] = gain;
  }
}

/// Computes the motion of each coordinate's body per rate of its free coordinate: turn, and velocity of the body's
/// point at the origin of ground.
void PoseFit::update_motions() {
  for (std::size_t c = 0; c < reduced_.size(); ++c) {
    if (reduced_[c] < 0) continue;
    const double gain = gain_[static_cast<Eigen::Index>(c)];
    const Vec3& p_G = state_.X_GB[at(model_.joints[at(model_.coordinates[c].joint)].child)].p;
    motions_[c].w = gain * state_.H_w_G[c];
    motions_[c].v = gain * state_.H_v_G[c] + p_G.cross(motions_[c].w);
  }
}

PoseFit::Pull& PoseFit::Pull::operator+=(const Pull& other) {
  weight += other.weight;
  first += other.first;
  second += other.second;
  force += other.force;
  lever += other.lever;
  return *this;
}

/// Sums up the pulls of the markers on each body, all about the origin of ground.
void PoseFit::gather_pulls() {
  std::fill(pulls_.begin(), pulls_.end(), Pull{});
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (!targets_.seen[i]) continue;
    const Vec3& p_G = place_[i];
    const Vec3 first = pairs_[i].weight * targets_.scale * p_G;
    const Vec3 force = first - pairs_[i].weight * targets_.scale * targets_.place_m[i];
    Pull& pull = pulls_[at(model_.markers[pairs_[i].model].body)];
    pull.weight += pairs_[i].weight * targets_.scale;
    pull.first += first;
    pull.second.noalias() += first * p_G.transpose();
    pull.force += force;
    pull.lever.noalias() += p_G * force.transpose();
  }
}

/// Adds the derivatives by the coordinate at place b of a chain, also mixed with earlier coordinates.
void PoseFit::add_coordinate(const Chain& chain, std::size_t b, const Pull& pull) {
  const int cb = chain.coordinates[b];
  const int kb = reduced_[at(cb)];
  if (kb < 0) return;
  // A marker at r has the velocity v + w x r.
  const auto& [w, v] = motions_[at(cb)];
  const Vec3 moved = pull.weight * v + w.cross(pull.first);
  const Vec3 turned = pull.first.cross(v) + pull.second.trace() * w - pull.second * w;
  const Vec3 bent = v.cross(pull.force) + pull.lever * w - pull.lever.trace() * w;
  const Vec3 torque(pull.lever(1, 2) - pull.lever(2, 1), pull.lever(2, 0) - pull.lever(0, 2),
                    pull.lever(0, 1) - pull.lever(1, 0));
  slopes_.gradient[kb] += v.dot(pull.force) + w.dot(torque);
  for (std::size_t a = 0; a <= b; ++a) {
    const int ka = reduced_[at(chain.coordinates[a])];
    if (ka < 0) continue;
    const auto& [w_a, v_a] = motions_[at(chain.coordinates[a])];
    // Two coordinates of one free coordinate have both mixed derivatives on the diagonal.
    const double times = a != b && ka == kb ? 2.0 : 1.0;
    slopes_.gauss(std::max(ka, kb), std::min(ka, kb)) += times * (v_a.dot(moved) + w_a.dot(turned));
    // The column of an outer coordinate turns with a: its derivative is w_a x column.
    slopes_.bend(std::max(ka, kb), std::min(ka, kb)) += times * w_a.dot(bent);
  }
}

/// Computes the derivatives of J at the posture of the last cost_at(q); of second ones the lower triangle.
void PoseFit::linearize(const Eigen::VectorXd& q) {
  const auto n = static_cast<Eigen::Index>(free_.size());
  slopes_.stepped = q;
  update_gains(q);
  slopes_.gradient.setZero(n);
  slopes_.gauss.setZero(n, n);
  slopes_.bend.setZero(n, n);
  update_motions();
  gather_pulls();
  for (std::size_t j = model_.joints.size(); j-- > 0;) {
    const body::Joint& joint = model_.joints[j];
    const Chain& chain = chains_[at(joint.child)];
    const Pull& pull = pulls_[at(joint.child)];
    pulls_[at(joint.parent)] += pull;
    if (pull.weight == 0.0) continue;
    for (std::size_t b = chain.coordinates.size(); b-- > 0;) {
      if (chain.body_of[b] != at(joint.child)) break;
      add_coordinate(chain, b, pull);
    }
  }
  for (std::size_t j = 0; j < task_index_.size(); ++j) {
    const int c = task_index_[j];
    const int k = reduced_[at(c)];
    if (k < 0) continue;
    const double weight = options_.tasks[j].weight;
    slopes_.gradient[k] += weight * gain_[c] * (q[c] - target_of(j));
    slopes_.gauss(k, k) += weight * gain_[c] * gain_[c];
  }
  if (barrier_.acts()) barrier_.add_derivatives(q, slopes_.gradient, slopes_.gauss);
}

}  // namespace myoid::body
