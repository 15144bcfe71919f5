#pragma once

#include <string>
#include <vector>

#include "myoid/muscle/fit_isolated.h"

namespace myoid::test {

/// A muscle of 2 N with fibers and a tendon of 20 mm each.
inline muscle::IsolatedModel small_muscle() {
  const double l0 = 0.02;
  const muscle::MusculotendonLaws laws = muscle::millard_laws();
  muscle::IsolatedModel model{.laws = laws};
  model.parameters = muscle::published_defaults({.max_isometric_force_n = 2.0,
                                                 .optimal_fiber_length_m = l0,
                                                 .force_length_width_m = 0.45 * l0,
                                                 .concentric_curvature = 0.25,
                                                 .eccentric_curvature_product = 0.04,
                                                 .eccentric_plateau = 1.4,
                                                 .max_shortening_speed_mps = 6.0 * l0,
                                                 .tendon_slack_length_m = l0},
                                                laws);
  return model;
}

/// A recording, without its force, in which the muscle's length swings by `amplitude_m` at full drive.
inline muscle::IsolatedRecording swing(double amplitude_m, const std::string& name) {
  muscle::IsolatedRecording r{.name = name};
  r.input.time_s = Eigen::VectorXd::LinSpaced(41, 0.0, 1.0);
  r.input.length_m = (0.0405 + amplitude_m * (14.0 * r.input.time_s.array()).sin()).matrix();
  r.input.drive = Eigen::VectorXd::Ones(1);
  r.time_s = Eigen::VectorXd::LinSpaced(60, 0.0, 0.98);
  return r;
}

/// Recordings of such swings, with the forces of the muscle that excitation drives from rest.
inline std::vector<muscle::IsolatedRecording> swings(const muscle::IsolatedModel& truth,
                                                     const std::vector<double>& amplitudes_m) {
  std::vector<muscle::IsolatedRecording> list;
  for (const double amplitude_m : amplitudes_m) {
    muscle::IsolatedRecording& r = list.emplace_back(swing(amplitude_m, "swing"));
    r.input.drive_is_excitation = true;
    r.input.initial_activation = 0.01;
    r.force_n = isolated_force(truth, r);
  }
  return list;
}

}  // namespace myoid::test
