#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/kinematics/muscle_kinematics.h"

namespace myoid::body {

/// Columns of a model's muscles that count as one muscle, and their weights (summing to 1).
struct MuscleGroup {
  std::vector<int> members;
  std::vector<double> weights;
};

/// Lumped muscles along a motion: the weighted means over their heads, n x m each.
struct LumpedMuscles {
  Eigen::MatrixXd length_m;      ///< Musculotendon length.
  Eigen::MatrixXd velocity_mps;  ///< dl/dt, lengthening positive.
  Eigen::MatrixXd moment_arm_m;  ///< Moment arms by one coordinate, r = -dl/dq.
};

/// Returns moment arms r = -dl/dq by one coordinate, n x m [m].
[[nodiscard]] Eigen::MatrixXd lumped_moment_arm_m(const body::MuscleKinematics& muscles,
                                                  const std::vector<MuscleGroup>& groups,
                                                  const std::string& coordinate);

/// Returns the weighted means over the heads of each group.
[[nodiscard]] LumpedMuscles lumped_muscles(const body::MuscleKinematics& muscles,
                                           const std::vector<MuscleGroup>& groups,
                                           const std::string& coordinate);

}  // namespace myoid::body
