#include "myoid/body/dynamics/forward_dynamics.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::body {
namespace {

/// Returns the coordinate that moves most in the motion with the least mass.
const std::string& massless_coordinate(const body::BodyModel& model,
                                       const Eigen::MatrixXd& allowed,
                                       const Eigen::MatrixXd& reduced) {
  const math::SymmetricEigen modes = math::symmetric_eigen(reduced);
  Eigen::Index most = 0;
  (allowed * modes.vectors.col(0)).cwiseAbs().maxCoeff(&most);
  return model.coordinates[at(most)].name;
}

}  // namespace

void ForwardDynamics::set(const Eigen::VectorXd& q, const Eigen::VectorXd& qdot, double time_s) {
  const Eigen::Index n = q.size();
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n);
  const Eigen::VectorXd weight = body::inverse_dynamics(*model_, q, rest, rest, {}, state_);
  mass_.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    mass_.col(k) = body::inverse_dynamics(*model_, q, rest, Eigen::VectorXd::Unit(n, k), {}, state_) - weight;
  }
  body::compute_velocities(*model_, qdot, state_);
  constraints_ = body::acceleration_constraints(*model_, state_, time_s);
  allowed_ = Eigen::MatrixXd::Identity(n, n);
  particular_ = rest;
  if (constraints_.A.rows() > 0) {
    allowed_ = math::null_space(constraints_.A);
    particular_ = math::shortest_solution(constraints_.A, constraints_.b, 1e-9);
  }
  const Eigen::MatrixXd reduced = allowed_.transpose() * mass_ * allowed_;
  if (reduced.size() == 0) return;
  factor_.compute(reduced);
  if (factor_.info() != Eigen::Success || !(factor_.rcond() > 1e-15)) {
    throw ModelError(
        fmt::format("forward dynamics: coordinate '{}' moves bodies without mass, so that its "
                    "acceleration is not known; give them a mass, or lock it",
                    massless_coordinate(*model_, allowed_, reduced)));
  }
}

ForwardDynamics::Solution ForwardDynamics::solve(const Eigen::VectorXd& tau,
                                                 const std::vector<body::BodyWrench>& wrenches) {
  const Eigen::VectorXd q = state_.q, qdot = state_.qdot;
  const Eigen::VectorXd driving =
      tau - body::inverse_dynamics(*model_, q, qdot, Eigen::VectorXd::Zero(q.size()), wrenches, state_);
  Solution solution;
  solution.qddot = particular_;
  if (allowed_.cols() > 0) {
    solution.qddot += allowed_ * factor_.solve(allowed_.transpose() * (driving - mass_ * particular_));
  }
  solution.multipliers.resize(constraints_.A.rows());
  if (solution.multipliers.size() > 0) {
    solution.multipliers = math::shortest_solution(constraints_.A.transpose(), mass_ * solution.qddot - driving, 1e-9);
  }
  return solution;
}

}  // namespace myoid::body
