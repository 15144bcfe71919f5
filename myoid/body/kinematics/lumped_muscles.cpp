#include "myoid/body/kinematics/lumped_muscles.h"

namespace myoid::body {
namespace {

/// Returns the weighted means over the heads of each group: n x groups from n x muscles.
Eigen::MatrixXd lumped(const Eigen::MatrixXd& of_heads, const std::vector<MuscleGroup>& groups) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(of_heads.rows(), static_cast<Eigen::Index>(groups.size()));
  for (Eigen::Index g = 0; g < result.cols(); ++g) {
    const MuscleGroup& group = groups[static_cast<std::size_t>(g)];
    for (std::size_t i = 0; i < group.members.size(); ++i)
      result.col(g) += group.weights[i] * of_heads.col(group.members[i]);
  }
  return result;
}

}  // namespace

Eigen::MatrixXd lumped_moment_arm_m(const body::MuscleKinematics& muscles,
                                    const std::vector<MuscleGroup>& groups,
                                    const std::string& coordinate) {
  return lumped(muscles.moment_arm.at(coordinate).values(), groups);
}

LumpedMuscles lumped_muscles(const body::MuscleKinematics& muscles,
                             const std::vector<MuscleGroup>& groups,
                             const std::string& coordinate) {
  return {.length_m = lumped(muscles.length.values(), groups),
          .velocity_mps = lumped(muscles.velocity.values(), groups),
          .moment_arm_m = lumped_moment_arm_m(muscles, groups, coordinate)};
}

}  // namespace myoid::body
