#include "myoid/methods/motion_alone.h"

#include <algorithm>
#include <map>
#include <vector>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/math/explained_share.h"

namespace myoid::identification {
namespace {

constexpr double kAlone = 0.98;

/// Returns 1, q, dq/dt and d2q/dt2, n x 4; no rows where the trial has no motion.
Eigen::MatrixXd motion_of(const TrialData& trial) {
  const Eigen::Index n = trial.torque_nm.size();
  if (trial.angle_rad.size() != n || trial.velocity_radps.size() != n ||
      trial.acceleration_radps2.size() != n)
    return Eigen::MatrixXd(0, 4);
  Eigen::MatrixXd motion(n, 4);
  motion << Eigen::VectorXd::Ones(n), trial.angle_rad, trial.velocity_radps,
      trial.acceleration_radps2;
  return motion;
}

/// Returns the share of the torque of one joint in all of its trials.
std::optional<double> told(const std::vector<TrialData>& trials) {
  Eigen::Index count = 0;
  for (const TrialData& trial : trials) count += trial.torque_nm.size();
  Eigen::MatrixXd motion(count, 4);
  Eigen::VectorXd torque(count);
  Eigen::Index first = 0;
  for (const TrialData& trial : trials) {
    const Eigen::MatrixXd of = motion_of(trial);
    if (of.rows() == 0) return std::nullopt;
    motion.middleRows(first, of.rows()) = of;
    torque.segment(first, of.rows()) = trial.torque_nm;
    first += of.rows();
  }
  const Eigen::VectorXd size = motion.colwise().norm().cwiseMax(1e-12);
  const Eigen::MatrixXd scaled = motion * size.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd normal =
      scaled.transpose() * scaled + 1e-12 * Eigen::MatrixXd::Identity(4, 4);
  return math::explained_share(scaled * normal.llt().solve(scaled.transpose() * torque), torque);
}

}  // namespace

std::optional<double> told_by_motion_alone(const StudyData& data) {
  std::map<std::string, std::vector<TrialData>> by_joint;
  for (const TrialData& trial : data.trials) {
    for (std::size_t j = 0; trial.calibration && j < joint_count(trial); ++j) {
      TrialData one = of_joint(trial, j);
      by_joint[one.joint].push_back(std::move(one));
    }
  }
  std::optional<double> least;
  for (const auto& [joint, trials] : by_joint) {
    const std::optional<double> share = told(trials);
    if (!share) return std::nullopt;
    least = std::min(least.value_or(1.0), *share);
  }
  return least;
}

std::optional<std::string> motion_alone_warning(const StudyData& data) {
  const std::optional<double> share = told_by_motion_alone(data);
  if (!share || *share < kAlone) return std::nullopt;
  return fmt::format(
      "angle, rate and acceleration alone tell {:.1f} % of the torque's variance: no fit can tell "
      "the muscles from a spring and an inertia, and intervals may miss the truth. Record efforts "
      "against several loads, or at held angles",
      100.0 * *share);
}

}  // namespace myoid::identification
