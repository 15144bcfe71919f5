#pragma once

#include <Eigen/Core>

#include "myoid/model/body_model.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::model {

/// Sets the dependent coordinates of all couplers to what their independent ones say; chains of
/// couplers included. Throws ModelError if couplers depend on each other in a circle.
void apply_couplers(const BodyModel& model, Eigen::VectorXd& q);

/// How far the constraints other than couplers are from being met, [m] and (sine of) [rad], one row
/// each; empty without such constraints. `compute_poses` must have been called.
[[nodiscard]] Eigen::VectorXd constraint_errors(const BodyModel& model, const BodyState& state);

/// Rows: every coupler, then every other constraint; columns: coordinates. Rates qdot obey the
/// constraints if A qdot = 0. `compute_poses` must have been called.
[[nodiscard]] Eigen::MatrixXd constraint_jacobian(const BodyModel& model, const BodyState& state);

/// Column c: the rates of all coordinates when coordinate c moves at rate 1 and the constraints
/// hold, the others moving as little as possible; other locked coordinates stay, c itself is taken
/// as unlocked. The unit matrix without constraints. The moment arms that OpenSim reports are
/// C^T r, with r by every coordinate on its own (muscle_path.h): a coordinate takes along what is
/// coupled with it, and a dependent one its independent one. A coordinate that the constraints do
/// not let move has a column of zeros. `compute_poses` must have been called.
[[nodiscard]] Eigen::MatrixXd coupling_matrix(const BodyModel& model, const BodyState& state);

struct AssemblyResult {
  Eigen::VectorXd q;
  double error = 0.0;  ///< Greatest constraint error, [m] or [rad].
  bool converged = false;
};

/// The posture nearest to q (over the coordinates that are not dependent) that meets every
/// constraint within `accuracy`; locked and prescribed coordinates keep their values in q. With
/// couplers only it is exact at once.
[[nodiscard]] AssemblyResult assemble(const BodyModel& model,
                                      const Eigen::Ref<const Eigen::VectorXd>& q,
                                      double accuracy = 1e-9);

}  // namespace myoid::model
