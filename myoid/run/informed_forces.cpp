#include "myoid/run/informed_forces.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/body/forces/force_sharing.h"
#include "myoid/ground/core/error.h"

namespace myoid::run {
namespace {

/// Throws InvalidInput unless the trial has torque, moment arms and activations for all muscles.
void check_sizes(const fit::TrialData& trial,
                 const Eigen::MatrixXd& measured,
                 const std::vector<fit::MuscleValues>& muscles) {
  const Eigen::Index n = trial.time_s.size();
  const auto m = static_cast<Eigen::Index>(muscles.size());
  if (trial.torque_nm.size() != n || trial.moment_arm_m.rows() != n || trial.moment_arm_m.cols() != m ||
      trial.length_m.cols() != m || measured.rows() != n || measured.cols() != m) {
    throw InvalidInput(
        fmt::format("trial '{}' has no torque, moment arms or activations for {} muscles", trial.name, m));
  }
}

/// Returns the moment arms of all joints at sample i; joints x muscles.
Eigen::MatrixXd moment_arms_at(const fit::TrialData& trial, Eigen::Index i) {
  Eigen::MatrixXd arms(static_cast<Eigen::Index>(fit::joint_count(trial)), trial.moment_arm_m.cols());
  for (Eigen::Index j = 0; j < arms.rows(); ++j)
    arms.row(j) = fit::joint_at(trial, static_cast<std::size_t>(j)).moment_arm_m.row(i);
  return arms;
}

/// Returns the torques of the joints without their resting torques; n x joints.
Eigen::MatrixXd torques_of_muscles(const fit::TrialData& trial) {
  Eigen::MatrixXd active_nm(trial.time_s.size(), static_cast<Eigen::Index>(fit::joint_count(trial)));
  for (std::size_t j = 0; j < fit::joint_count(trial); ++j) {
    const fit::TrialData one = fit::of_joint(trial, j);
    active_nm.col(static_cast<Eigen::Index>(j)) = one.torque_nm - fit::resting_torque_nm(one);
  }
  return active_nm;
}

}  // namespace

InformedForces informed_forces(const fit::TrialData& trial,
                               const Eigen::MatrixXd& measured,
                               const std::vector<fit::MuscleValues>& muscles,
                               const InformedSharing& options) {
  check_sizes(trial, measured, muscles);
  const Eigen::Index n = trial.time_s.size();
  const auto m = static_cast<Eigen::Index>(muscles.size());
  const auto joints = static_cast<Eigen::Index>(fit::joint_count(trial));
  InformedForces result{.trial = trial.name,
                        .time_s = trial.time_s,
                        .activation = Eigen::MatrixXd(n, m),
                        .measured = measured,
                        .force_n = Eigen::MatrixXd(n, m),
                        .reserve_nm = Eigen::MatrixXd(n, joints)};
  const Eigen::MatrixXd active_nm = torques_of_muscles(trial);
  const auto force_n = [&](Eigen::Index i, Eigen::Index k, double activation) {
    return fit::tension(activation, trial.length_m(i, k), trial.velocity_mps(i, k),
                        muscles[static_cast<std::size_t>(k)])
        .force_n;
  };
  Eigen::RowVectorXd rest(m), full(m);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < m; ++k) {
      // The sharing uses the muscle's activation; the law multiplies by the muscle's share.
      const double share = muscles[static_cast<std::size_t>(k)][fit::kShare];
      result.measured(i, k) = std::clamp(share * result.measured(i, k), 0.0, 1.0);
      rest[k] = force_n(i, k, 0.0);
      full[k] = force_n(i, k, 1.0 / share);
    }
    const Eigen::MatrixXd arms = moment_arms_at(trial, i);
    const Eigen::VectorXd torques = active_nm.row(i).transpose();
    const body::SharingSolution solution = body::solve_sharing(
        {.moment_arm = arms,
         .optimal_force = (full - rest).cwiseMax(0.0).transpose(),
         .torque = torques - arms * rest.transpose(),
         .lower = Eigen::VectorXd::Zero(m),
         .upper = Eigen::VectorXd::Ones(m),
         .weight = {},
         .reserve = Eigen::VectorXd::Constant(joints, options.reserve_nm),
         .emg = options.emg_weight > 0.0 ? Eigen::VectorXd(result.measured.row(i).transpose()) : Eigen::VectorXd(),
         .emg_weight = options.emg_weight,
         .exponent = 2.0});
    if (solution.status != body::SharingStatus::optimal && solution.status != body::SharingStatus::reserve_used) {
      ++result.frames_not_solved;
    }
    result.activation.row(i) = solution.activation.transpose();
    for (Eigen::Index k = 0; k < m; ++k) {
      result.force_n(i, k) = force_n(i, k, solution.activation[k] / muscles[static_cast<std::size_t>(k)][fit::kShare]);
    }
    result.reserve_nm.row(i) = (torques - arms * result.force_n.row(i).transpose()).transpose();
  }
  return result;
}

}  // namespace myoid::run
