#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/fit/posterior/noise_model.h"

namespace myoid::test {

/// How a person and a recording are made.
struct MadePersonOptions {
  int trials = 4;
  double seconds = 12.0;
  double rate_hz = 100.0;
  double emg_bandwidth_hz = 150.0;
  bool two_muscles = false;  ///< Biceps and triceps alone.
  /// The torque is drawn from the posterior's own model at the true unknowns: the drive is the one that the estimator
  /// takes from the envelopes, its error and the unseen quantities act by their columns.
  bool of_the_model = false;
  double drive_hz = 1.2;  ///< Highest -3 dB frequency of a channel's drive; the lowest is a third.
  std::uint64_t seed = 1;
};

/// A person drawn from every prior of the posterior, and the recording made of this person.
struct MadePerson {
  fit::StudyData data;
  fit::EstimatorOptions options;
  Eigen::VectorXd z;       ///< The unknowns, in the solver's scale.
  fit::NoiseValues noise;  ///< The hyperparameters.
};

/// The built-in arm's elbow muscles with one EMG channel each. Drawn are the study's unknowns
/// (from their priors within their bounds: muscles, delay, gains, offset of the torque), the
/// hyperparameters, and every unseen quantity, N(0, weight^2):
///
/// - moment arms r (1 + alpha + beta x), which change length and rate, too,
/// - slack lengths and strains of the tendons, by the law of the muscle,
/// - each channel's effort and gain drift, and cross-talk added to the recorded envelopes,
/// - the scale of the torque, and the model's error as a factor of each muscle's torque.
///
/// The literature's spreads are multiplied by a factor of the person's own (Density::unlikeness).
/// The drives are positive shot noise behind a Gaussian low-pass. An envelope is the drive times
/// 1 + white noise behind the envelope's filter; the torque's error is an autoregressive process.
[[nodiscard]] MadePerson made_person(const MadePersonOptions& options);

}  // namespace myoid::test
