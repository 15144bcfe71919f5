#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/forces/sharing_objective.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

/// The sharing of the torques of one instant among muscles.
///
///   minimize  sum_i w_i |x_i|^p + W sum_i (x_i - e_i)^2 + sum_k |y_k|^p
///   subject to  sum_i r_ki F_i^opt x_i + T_k y_k = tau_k,   lower <= x <= upper,   y free
///
/// x are activations (forces F_i = F_i^opt x_i), y the commands of the reserve actuators of optimal torque T_k.
struct SharingProblem {
  Eigen::MatrixXd moment_arm;     ///< Coordinates x muscles: r [m].
  Eigen::VectorXd optimal_force;  ///< F^opt [N]: force at full activation at this instant.
  Eigen::VectorXd torque;         ///< tau [N m]
  Eigen::VectorXd lower, upper;   ///< Bounds of the activations.
  Eigen::VectorXd weight;         ///< w; empty: 1 for all.
  Eigen::VectorXd reserve;        ///< T [N m]; > 0.
  Eigen::VectorXd emg;            ///< e; empty: no EMG term.
  double emg_weight = 0.0;        ///< W; needs exponent 2.
  double exponent = 2.0;          ///< p > 1
};

enum class SharingStatus {
  optimal,       ///< Torques balanced, optimality certified.
  reserve_used,  ///< Optimal, but a reserve carries more than 5 % of its coordinate's greatest
                 ///< torque in the series.
  not_solved,    ///< The search gave up; see the residual.
  not_finite,    ///< An input was not a number.
};
[[nodiscard]] std::string_view name(SharingStatus status);

struct SharingSolution {
  Eigen::VectorXd activation;      ///< x
  Eigen::VectorXd reserve_torque;  ///< T y [N m]
  Eigen::VectorXd multiplier;      ///< lambda of the torque balance.
  double kkt_residual = 0.0;       ///< Largest violation of the optimality conditions, relative: see optimality.h.
  int iterations = 0;
  SharingStatus status = SharingStatus::not_solved;
};

/// Solves the convex problem by Newton's method on its dual: the activations follow from the
/// multipliers in closed form, x_i = clip((sum_k lambda_k r_ki F_i / (p w_i))^(1/(p-1))), and the
/// reserves keep the dual strictly concave. Exact to round-off. Throws InvalidInput if sizes
/// disagree, p <= 1, a reserve is not positive, or an EMG term is asked for with p other than 2.
[[nodiscard]] SharingSolution solve_sharing(const SharingProblem& problem);

/// A muscle's force at an activation, and its derivative by the activation.
struct ForceAtActivation {
  double force_n = 0.0, slope_n = 0.0;
};
/// The law F(x) of a muscle in a frame, if it is not F_opt x: passive force, elastic tendon. Called from any thread.
using MuscleForceLaw = std::function<ForceAtActivation(Eigen::Index frame, Eigen::Index muscle, double activation)>;

/// Solves the problem with forces F_i(x_i) instead of F_i^opt x_i, as a sequence of problems with the laws' tangents,
/// until activations change by less than 1e-11. `problem.torque` is the whole torque. For nonlinear laws the optimum is
/// a local one: the search begins at `start`. The certificate belongs to the tangent problem at the solution, whose
/// optimality conditions equal the problem's own.
[[nodiscard]] SharingSolution solve_sharing(
    const SharingProblem& problem,
    const std::function<ForceAtActivation(Eigen::Index muscle, double activation)>& law,
    const Eigen::VectorXd& start);

struct SharingOptions {
  SharingObjective objective = SharingObjective::activation;
  double exponent = 2.0;
  double reserve_nm = 1.0;
  double min_activation = 0.0;
  TimeSeries emg;  ///< Optional: activations by muscle name, on the same clock.
  double emg_weight = 0.0;
  MuscleForceLaw law{};  ///< Optional; else F_opt x. The weights use F_opt in both cases.
};

/// Shared forces over time; channels of `force` and `activation` are the muscles.
struct MuscleForces {
  TimeSeries force;                   ///< [N]
  TimeSeries activation;              ///< [-]
  TimeSeries reserve;                 ///< "<coordinate>_reserve" [N m]
  std::vector<SharingStatus> status;  ///< Per frame.
  Eigen::VectorXd kkt_residual;       ///< Per frame.
  int frames_not_solved = 0;
  int frames_with_reserve = 0;
};

/// Shares the torques of one or more coordinates in every frame. `moment_arms` has one series per coordinate, in the
/// order of `torques`' channels; `optimal_force_n` is frames x muscles; all on one clock. `max_isometric_force_n`
/// serves the objective `stress`. Parallel over frames; the same for every number of threads.
[[nodiscard]] MuscleForces share(const std::vector<TimeSeries>& moment_arms,
                                 const TimeSeries& torques,
                                 const Eigen::MatrixXd& optimal_force_n,
                                 const Eigen::VectorXd& max_isometric_force_n,
                                 const SharingOptions& options = {});

}  // namespace myoid::body
