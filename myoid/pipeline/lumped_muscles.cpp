#include "myoid/pipeline/lumped_muscles.h"

namespace myoid::pipeline {

LumpedMuscles lumped_muscles(const kinematics::MuscleKinematics& muscles,
                             const std::vector<MuscleGroup>& groups,
                             const std::string& coordinate) {
  const Eigen::MatrixXd& arms = muscles.moment_arm.at(coordinate).values();
  const Eigen::MatrixXd none =
      Eigen::MatrixXd::Zero(arms.rows(), static_cast<Eigen::Index>(groups.size()));
  LumpedMuscles lumped{none, none, none};
  for (Eigen::Index g = 0; g < none.cols(); ++g) {
    const MuscleGroup& group = groups[static_cast<std::size_t>(g)];
    for (std::size_t i = 0; i < group.members.size(); ++i) {
      const Eigen::Index head = group.members[i];
      lumped.length_m.col(g) += group.weights[i] * muscles.length.values().col(head);
      lumped.velocity_mps.col(g) += group.weights[i] * muscles.velocity.values().col(head);
      lumped.moment_arm_m.col(g) += group.weights[i] * arms.col(head);
    }
  }
  return lumped;
}

}  // namespace myoid::pipeline
