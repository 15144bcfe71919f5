#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/posterior/trial_run.h"

namespace myoid::identification {

/// The joints that each muscle crosses, and the part of its length l [m] that each of them makes.
///
/// Of a muscle of one joint it is the whole length. Otherwise the angles follow from the lengths of
/// all muscles by the recording's mean moment arms R, joints x muscles:
///
///   dq = -(R')^+ dl,   dl_jk = -R_jk dq_j + R_jk^2 / (sum_i R_ik^2) (dl_k + sum_i R_ik dq_i)
///
/// The parts add to the length. They need no angles, and a trial that shows one of the joints only
/// has the same parts. With constant moment arms they are exact.
class JointParts {
 public:
  JointParts() = default;
  explicit JointParts(const std::vector<TrialRun>& runs);

  /// Joints of the recording, as ParameterMap::joints().
  [[nodiscard]] int joint_count() const { return static_cast<int>(weights_.size()); }
  /// Whether the moment arm reaches 0.1 mm. Of one joint all muscles do.
  [[nodiscard]] bool crosses(std::size_t muscle, int joint) const;
  /// The joint's part, n, of the muscle's length, up to a constant, or of its rate, by the lengths
  /// or rates of all muscles, n x muscles.
  [[nodiscard]] Eigen::VectorXd of(const Eigen::MatrixXd& all_muscles,
                                   std::size_t muscle,
                                   int joint) const;

 private:
  Eigen::MatrixXd longest_arm_m_;         ///< joints x muscles
  std::vector<Eigen::MatrixXd> weights_;  ///< Per joint: column k are those of muscle k's part.
};

}  // namespace myoid::identification
