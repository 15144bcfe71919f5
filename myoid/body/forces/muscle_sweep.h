#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/path_survey.h"
#include "myoid/ground/core/progress.h"

namespace myoid::body {

/// One muscle at each value of a coordinate, the other coordinates at their defaults.
struct SweptMuscle {
  std::string name;
  body::PathOverRange path;
  /// Along the tendon [N], at rest: of the fully active muscle and of the muscle without activation, fiber and tendon
  /// in balance. NaN where no balance was found.
  Eigen::VectorXd full_force_n, passive_force_n;
  bool has_own_curves = true;  ///< False: this program has no curves of the muscle's class, Thelen's are taken.

  /// Returns true if the moment arm is 0.1 mm or more somewhere.
  [[nodiscard]] bool has_moment_arm() const { return path.arms_m.cwiseAbs().maxCoeff() >= 1e-4; }
};

/// Returns these muscles at steps + 1 values of the coordinate. Throws InvalidInput for a coordinate that a closed loop
/// of the model binds to others.
[[nodiscard]] std::vector<SweptMuscle> sweep_muscles(const body::BodyModel& model,
                                                     const std::vector<int>& muscles,
                                                     int coordinate,
                                                     const body::CoordinateRange& range,
                                                     int steps,
                                                     const Progress& progress = {});

}  // namespace myoid::body
