#include "myoid/posterior/joint_parts.h"

#include <algorithm>

#include "myoid/math/decompositions.h"

namespace myoid::identification {
namespace {

constexpr double kLeastArm_m = 1e-4;

}  // namespace

JointParts::JointParts(const std::vector<TrialRun>& runs) {
  int joints = 0;
  for (const TrialRun& run : runs)
    joints = std::max(joints, 1 + *std::max_element(run.joints.begin(), run.joints.end()));
  const Eigen::Index muscles = runs.front().arm_m.cols();
  longest_arm_m_.setZero(joints, muscles);
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(joints, muscles);
  Eigen::VectorXd samples = Eigen::VectorXd::Zero(joints);
  for (const TrialRun& run : runs) {
    const Eigen::Index n = run.time_s.size();
    for (std::size_t j = 0; j < run.joints.size(); ++j) {
      const Eigen::Index joint = run.joints[j];
      const auto arms = run.arm_m.middleRows(run.first_row(j), n);
      mean.row(joint) += arms.colwise().sum();
      samples[joint] += static_cast<double>(n);
      longest_arm_m_.row(joint) = longest_arm_m_.row(joint).cwiseMax(arms.cwiseAbs().colwise().maxCoeff());
    }
  }
  mean.array().colwise() /= samples.array().max(1.0);
  // joints x muscles: dq = -turn dl.
  const Eigen::MatrixXd turn = math::pseudo_inverse(mean.transpose());
  // The rest of dl, which the angles do not explain.
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(muscles, muscles) - turn.transpose() * mean;
  const Eigen::RowVectorXd squared = mean.colwise().squaredNorm().cwiseMax(1e-300);
  for (Eigen::Index joint = 0; joint < joints; ++joint) {
    const Eigen::RowVectorXd share = mean.row(joint).cwiseAbs2().cwiseQuotient(squared);
    weights_.emplace_back(turn.row(joint).transpose() * mean.row(joint) + left * share.asDiagonal());
  }
}

bool JointParts::crosses(std::size_t muscle, int joint) const {
  return joint_count() == 1 || longest_arm_m_(joint, static_cast<Eigen::Index>(muscle)) > kLeastArm_m;
}

Eigen::VectorXd JointParts::of(const Eigen::MatrixXd& all_muscles, std::size_t muscle, int joint) const {
  const auto k = static_cast<Eigen::Index>(muscle);
  if ((longest_arm_m_.col(k).array() > kLeastArm_m).count() < 2) return all_muscles.col(k);
  return all_muscles * weights_[static_cast<std::size_t>(joint)].col(k);
}

}  // namespace myoid::identification
