#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/posterior/trial_run.h"

namespace myoid::fit {

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

/// Recorded lengths and speeds of the muscles, and the torque: they scale the shapes of the errors,
/// in fitted and in predicted trials.
struct Recorded {
  struct Range {
    double shortest_m = 1e9, longest_m = -1e9, fastest_mps = 1e-9;
    [[nodiscard]] double span_m() const;
    /// Returns the place of each length in the range, -1 to 1.
    [[nodiscard]] Eigen::ArrayXd place(const Eigen::ArrayXd& length_m) const;
  };
  std::vector<Range> muscles;
  JointParts parts;
  std::vector<std::vector<Range>> by_joint;  ///< Ranges of the parts, by joint and muscle.
  double torque_nm = 0.0;                    ///< Root mean square of L y.
  std::vector<double> joint_torque_nm;       ///< Root mean square of each joint's L y.
  double told_by_motion = 0.0;               ///< told_by_motion_alone of all calibration trials.

  /// Returns the joint's `joint_torque_nm` over `torque_nm`, at least a hundredth.
  [[nodiscard]] double size_share(int joint) const;
};

/// Returns the recorded ranges. A range is at least half an optimal fiber length: over a shorter
/// one neither a muscle's law nor its moment arm can err by as much.
[[nodiscard]] Recorded recorded(const std::vector<TrialRun>& runs, const std::vector<MuscleValues>& muscles);

}  // namespace myoid::fit
