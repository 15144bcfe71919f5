#pragma once

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/posterior/noise_model.h"

#include "tests/support/elbow_study.h"

namespace myoid::test {

/// Sizes of the errors of two trials, each with its own share of the torque's error.
inline const fit::NoiseValues kNoise =
    (fit::NoiseValues(10) << -0.9, -1.4, 0.1, -3.0, -0.3, 0.2, -0.6, 0.1, 0.3, -0.4).finished();
inline const fit::NoiseValues kNoiseOfLeg =
    (fit::NoiseValues(10) << 1.5, -1.4, 0.1, -3.0, -0.3, 0.2, -0.6, 0.1, -0.2, 0.5).finished();  // of some 60 N m

/// Two muscles on one electrode, exponent, gain, offset and an elastic law of length free.
inline ElbowStudy crowded_study() {
  ElbowStudy study =
      elbow_study({.trials = 2, .seconds = 6.0, .emg_cv = 0.08, .torque_sd_nm = 0.4, .with_priors = true});
  study.data.muscles[1].emg_channel = study.data.muscles[0].emg_channel;
  study.data.rules = {freed("emg_exponent"), freed("length_activation"), freed("joint_torque_offset")};
  study.data.rules[0].value = 1.2;
  study.data.rules[1].tie = true;
  study.data.rules[1].value = 0.1;
  return study;
}

inline fit::EstimatorOptions crowded_options() {
  fit::EstimatorOptions options;
  options.angle_sd_rad = 0.01;
  for (const char* channel : {"BIC", "BRD", "TRI"}) {
    options.state(channel).gain_sd = 0.1;
    options.state(channel).bandwidth_hz = 150.0;
  }
  return options;
}

}  // namespace myoid::test
