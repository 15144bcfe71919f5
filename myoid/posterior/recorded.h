#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/identification/parameters.h"
#include "myoid/posterior/joint_parts.h"
#include "myoid/posterior/trial_run.h"

namespace myoid::identification {

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

}  // namespace myoid::identification
