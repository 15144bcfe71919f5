#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/pipeline/study_model.h"

namespace myoid::pipeline {

/// The study's muscles along a motion, heads lumped by their weights: n x m each.
struct LumpedMuscles {
  Eigen::MatrixXd length_m;      ///< Musculotendon length.
  Eigen::MatrixXd velocity_mps;  ///< Of it, lengthening positive.
  Eigen::MatrixXd moment_arm_m;  ///< By the study's coordinate, r = -dl/dq.
};

/// Moment arms r = -dl/dq by one coordinate, n x m [m].
[[nodiscard]] Eigen::MatrixXd lumped_moment_arm_m(const kinematics::MuscleKinematics& muscles,
                                                  const std::vector<MuscleGroup>& groups,
                                                  const std::string& coordinate);

/// Weighted means over the heads of each group.
[[nodiscard]] LumpedMuscles lumped_muscles(const kinematics::MuscleKinematics& muscles,
                                           const std::vector<MuscleGroup>& groups,
                                           const std::string& coordinate);

}  // namespace myoid::pipeline
