#include "myoid/fit/measurement/told_by_motion.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

constexpr double kMoves_rad = 0.0873;  // 5 degrees: a joint that turns less is held

/// Torque and motion (1, q, dq/dt, d2q/dt2) of one joint in one trial.
struct Moved {
  Eigen::VectorXd torque_nm;
  Eigen::MatrixXd motion;  ///< n x kMotionCoefficients
};

/// Returns nothing where the data have no motion or the joint is held.
std::optional<Moved> moved(const JointData& joint) {
  const Eigen::Index n = joint.torque_nm.size();
  const Eigen::MatrixXd motion = motion_of(joint, n);
  if (motion.size() == 0 || motion.col(0).maxCoeff() - motion.col(0).minCoeff() < kMoves_rad) return std::nullopt;
  Moved found{joint.torque_nm, Eigen::MatrixXd(n, kMotionCoefficients)};
  found.motion << Eigen::VectorXd::Ones(n), motion;
  return found;
}

/// Returns the share of the torque of one joint in all of its trials.
double told(const std::vector<Moved>& trials) {
  Eigen::Index count = 0;
  for (const Moved& trial : trials) count += trial.torque_nm.size();
  Eigen::MatrixXd motion(count, kMotionCoefficients);
  Eigen::VectorXd torque(count);
  Eigen::Index first = 0;
  for (const Moved& trial : trials) {
    motion.middleRows(first, trial.motion.rows()) = trial.motion;
    torque.segment(first, trial.motion.rows()) = trial.torque_nm;
    first += trial.motion.rows();
  }
  const Eigen::VectorXd size = motion.colwise().norm().cwiseMax(1e-12);
  const Eigen::MatrixXd scaled = motion * size.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd normal =
      scaled.transpose() * scaled + 1e-12 * Eigen::MatrixXd::Identity(kMotionCoefficients, kMotionCoefficients);
  return math::explained_share(scaled * normal.llt().solve(scaled.transpose() * torque), torque);
}

}  // namespace

std::optional<double> told_by_motion_alone(const StudyData& data) {
  std::map<std::string, std::vector<Moved>> by_joint;
  for (const TrialData& trial : data.trials) {
    for (std::size_t j = 0; trial.calibration && j < joint_count(trial); ++j) {
      std::optional<Moved> of_joint = moved(joint_at(trial, j));
      if (!of_joint) return std::nullopt;
      by_joint[joint_at(trial, j).joint].push_back(std::move(*of_joint));
    }
  }
  std::optional<double> least;
  for (const auto& [name, trials] : by_joint) least = std::min(least.value_or(1.0), told(trials));
  return least;
}

}  // namespace myoid::fit
