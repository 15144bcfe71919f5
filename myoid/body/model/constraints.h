#pragma once

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"
#include "myoid/body/model/kinematic_tree.h"

namespace myoid::body {

/// Sets the dependent coordinates of all couplers, chains of couplers included, to their functions
/// of the independent coordinates. Throws ModelError if couplers depend on each other in a circle.
void apply_couplers(const BodyModel& model, Eigen::VectorXd& q);

/// The constraints other than couplers, one row each: errors, [m] and (sine of) [rad], and their derivatives by the
/// coordinates.
struct LoopEquations {
  Eigen::VectorXd errors;
  Eigen::MatrixXd jacobian;
};

/// Evaluates the loops; there are no rows without such constraints. `compute_poses` must have been called.
[[nodiscard]] LoopEquations loop_equations(const BodyModel& model, const BodyState& state);

/// Returns one row for every coupler, then for every other constraint; columns: coordinates. Rates
/// qdot obey the constraints if A qdot = 0. `compute_poses` must have been called.
[[nodiscard]] Eigen::MatrixXd constraint_jacobian(const BodyModel& model, const BodyState& state);

/// Returns C, whose column c holds the rates of all coordinates when coordinate c moves at rate 1, the constraints hold
/// and the other coordinates move as little as possible. Other locked coordinates stay; c counts as unlocked. A
/// coordinate that the constraints fix has a column of zeros. Without constraints C is the unit matrix. The moment arms
/// that OpenSim reports are C^T r, with the arms r by every coordinate alone (muscle_path.h). `compute_poses` must have
/// been called.
[[nodiscard]] Eigen::MatrixXd coupling_matrix(const BodyModel& model, const BodyState& state);

struct AssemblyResult {
  Eigen::VectorXd q;
  double error = 0.0;  ///< Greatest constraint error, [m] or [rad].
  bool converged = false;
};

/// Returns the posture nearest to q (over the independent coordinates) that meets every constraint within `accuracy`;
/// locked and prescribed coordinates keep their values in q. Couplers alone are met exactly.
[[nodiscard]] AssemblyResult assemble(const BodyModel& model,
                                      const Eigen::Ref<const Eigen::VectorXd>& q,
                                      double accuracy = 1e-9);

}  // namespace myoid::body
