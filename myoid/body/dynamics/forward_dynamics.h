#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "myoid/body/model/motion_constraints.h"

namespace myoid::body {

/// Accelerations of a model with all its constraints at one state, by multipliers:
///
///   M qddot + C - gravity = tau + external + A' lambda,   A qddot = b
///
/// A and b as in body::acceleration_constraints: couplers, closed loops, locks, prescribed coordinates. For redundant
/// constraints lambda is the shortest solution, as in Simbody. One object per thread.
class ForwardDynamics {
 public:
  explicit ForwardDynamics(const body::BodyModel& model) : model_(&model), state_(body::make_state(model)) {}

  /// Sets the state for `solve`; q must meet the constraints. Throws ModelError, naming a
  /// coordinate, if a motion that the constraints allow moves no mass.
  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& qdot, double time_s);

  [[nodiscard]] const body::BodyState& state() const { return state_; }

  struct Solution {
    Eigen::VectorXd qddot;
    Eigen::VectorXd multipliers;  ///< lambda, in the rows' order.
  };
  /// Solves. `tau`: forces along coordinates [N m, N]; `wrenches`: forces on bodies other than gravity.
  [[nodiscard]] Solution solve(const Eigen::VectorXd& tau, const std::vector<body::BodyWrench>& wrenches);

 private:
  const body::BodyModel* model_;
  body::BodyState state_;
  body::AccelerationConstraints constraints_;
  Eigen::MatrixXd mass_;
  Eigen::MatrixXd allowed_;                                              ///< Basis of the rates with A qdot = 0.
  Eigen::VectorXd particular_;                                           ///< The shortest qddot with A qddot = b.
  Eigen::LLT<Eigen::MatrixXd> factor_{Eigen::MatrixXd::Identity(1, 1)};  ///< Factored: a copy reads its state.
};

}  // namespace myoid::body
