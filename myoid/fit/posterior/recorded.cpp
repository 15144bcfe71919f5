#include "myoid/fit/posterior/recorded.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/math/decompositions.h"

namespace myoid::fit {
namespace {

constexpr double kLeastSpan = 0.5;  // of l0: the range of lengths of a muscle that is held
constexpr double kLeastArm_m = 1e-4;
constexpr double kLeastSpeed = 0.1;  // of v_max, likewise

/// Returns the range of one muscle's lengths and rates, n of each for every run.
template <typename Lengths>
Recorded::Range range_of(const std::vector<TrialRun>& runs, const MuscleValues& muscle, const Lengths& lengths) {
  Recorded::Range range;
  for (const TrialRun& run : runs) {
    const Eigen::VectorXd length = lengths(run.length_m);
    range.shortest_m = std::min(range.shortest_m, length.minCoeff());
    range.longest_m = std::max(range.longest_m, length.maxCoeff());
    range.fastest_mps = std::max(range.fastest_mps, lengths(run.velocity_mps).cwiseAbs().maxCoeff());
  }
  range.fastest_mps = std::max(range.fastest_mps, kLeastSpeed * muscle[kSpeed]);
  const double more = std::max(0.0, kLeastSpan * muscle[kFiberLength] - range.span_m());
  range.shortest_m -= 0.5 * more;
  range.longest_m += 0.5 * more;
  return range;
}

/// Fills the root mean squares of L y, over all joints and for each.
void add_torque_sizes(const std::vector<TrialRun>& runs, Recorded& found) {
  const auto joints = static_cast<std::size_t>(found.parts.joint_count());
  std::vector<double> sums(joints, 0.0), counts(joints, 0.0);
  for (const TrialRun& run : runs) {
    const Eigen::Index m = run.reduction.outputs();
    for (std::size_t j = 0; j < run.joints.size(); ++j) {
      const auto joint = static_cast<std::size_t>(run.joints[j]);
      sums[joint] += run.measured_nm.segment(static_cast<Eigen::Index>(j) * m, m).squaredNorm();
      counts[joint] += static_cast<double>(m);
    }
  }
  double sum = 0.0, count = 0.0;
  for (std::size_t j = 0; j < joints; ++j) {
    sum += sums[j];
    count += counts[j];
    found.joint_torque_nm.push_back(std::sqrt(sums[j] / std::max(counts[j], 1.0)));
  }
  found.torque_nm = std::sqrt(sum / count);
}

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

double Recorded::Range::span_m() const { return std::max(longest_m - shortest_m, 1e-6); }

Eigen::ArrayXd Recorded::Range::place(const Eigen::ArrayXd& length_m) const {
  return 2.0 * (length_m - shortest_m) / span_m() - 1.0;
}

double Recorded::size_share(int joint) const {
  const auto j = static_cast<std::size_t>(joint);
  if (j >= joint_torque_nm.size() || !(torque_nm > 0.0)) return 1.0;
  return std::max(joint_torque_nm[j] / torque_nm, 0.01);
}

Recorded recorded(const std::vector<TrialRun>& runs, const std::vector<MuscleValues>& muscles) {
  Recorded found{.parts = JointParts(runs)};
  found.by_joint.resize(static_cast<std::size_t>(found.parts.joint_count()));
  for (std::size_t k = 0; k < muscles.size(); ++k) {
    found.muscles.push_back(range_of(runs, muscles[k], [&](const Eigen::MatrixXd& all) {
      return Eigen::VectorXd(all.col(static_cast<Eigen::Index>(k)));
    }));
    for (int joint = 0; joint < found.parts.joint_count(); ++joint)
      found.by_joint[static_cast<std::size_t>(joint)].push_back(
          range_of(runs, muscles[k], [&](const Eigen::MatrixXd& all) { return found.parts.of(all, k, joint); }));
  }
  add_torque_sizes(runs, found);
  return found;
}

}  // namespace myoid::fit
