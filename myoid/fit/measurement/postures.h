#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Even places over the recorded range of a joint's angle, with the muscles' lengths and moment arms there: the means
/// of the recorded samples in bins, and straight lines between bins. Where the study has no angles the places are
/// lengths of one muscle.
struct Postures {
  bool over_angle = true;
  Eigen::VectorXd place;     ///< n, rising: angle [rad], or musculotendon length [m].
  Eigen::MatrixXd length_m;  ///< n x muscles
  Eigen::MatrixXd arm_m;     ///< n x muscles: moment arms about the joint.
  /// Per muscle: root mean square of the recorded lengths about the mean length at their angle. Other joints make it.
  Eigen::VectorXd scatter_m;
  /// Greatest recorded speed of the joint in the positive and in the negative direction.
  double fastest_radps = 0.0, fastest_back_radps = 0.0;

  [[nodiscard]] Eigen::Index count() const { return place.size(); }
};

/// Returns the postures of a joint from all trials. Without angles they are those of the lengths of `muscle`. Empty if
/// no trial has moment arms of this joint.
[[nodiscard]] Postures postures(const StudyData& data, const std::string& joint, std::size_t muscle);

}  // namespace myoid::fit
