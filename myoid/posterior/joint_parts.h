#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/posterior/trial_run.h"

namespace myoid::identification {

/// The joints that each muscle crosses, and each joint's part of the muscle's length l [m].
///
/// A muscle of one joint has its whole length as the part. Otherwise the angles follow from the
/// lengths of all muscles by the recording's mean moment arms R, joints x muscles:
///
///   dq = -(R')^+ dl,   dl_jk = -R_jk dq_j + R_jk^2 / (sum_i R_ik^2) (dl_k + sum_i R_ik dq_i)
///
/// The parts add to the length. They need no angles, so a trial that shows only one of the joints
/// has the same parts. With constant moment arms they are exact.
class JointParts {
 public:
  JointParts() = default;
  explicit JointParts(const std::vector<TrialRun>& runs);

  /// Number of joints of the recording, in the order of ParameterMap::joints().
  [[nodiscard]] int joint_count() const { return static_cast<int>(weights_.size()); }
  /// Returns true if the moment arm reaches 0.1 mm, or if there is only one joint.
  [[nodiscard]] bool crosses(std::size_t muscle, int joint) const;
  /// Returns the joint's part of the muscle's length (up to a constant) or rate, n values.
  /// `all_muscles` holds the lengths or rates of all muscles, n x muscles.
  [[nodiscard]] Eigen::VectorXd of(const Eigen::MatrixXd& all_muscles, std::size_t muscle, int joint) const;

 private:
  Eigen::MatrixXd longest_arm_m_;  ///< joints x muscles
  /// Per joint; column k gives the weights of muscle k's part.
  std::vector<Eigen::MatrixXd> weights_;
};

}  // namespace myoid::identification
