#pragma once

#include <numbers>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::test {

/// A swing of 1 Hz with the torque of an inertia and a spring, and one of `effort` beside it.
inline fit::TrialData swing(double effort_nm) {
  constexpr Eigen::Index kCount = 400;
  fit::TrialData trial;
  trial.name = "swing";
  trial.time_s = Eigen::VectorXd::LinSpaced(kCount, 0.0, 8.0);
  const Eigen::ArrayXd phase = 2.0 * std::numbers::pi * trial.time_s.array();
  trial.angle_rad = 1.2 + 0.8 * phase.sin();
  trial.velocity_radps = 0.8 * 2.0 * std::numbers::pi * phase.cos();
  trial.acceleration_radps2 = -0.8 * 4.0 * std::numbers::pi * std::numbers::pi * phase.sin();
  trial.torque_nm =
      0.08 * trial.acceleration_radps2.array() - 0.5 * trial.angle_rad.array() + effort_nm * (0.7 * phase).sin();
  trial.moment_arm_m = Eigen::MatrixXd::Constant(kCount, 1, 0.04);
  return trial;
}

}  // namespace myoid::test
