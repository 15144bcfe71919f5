#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/arm/planar_elbow.h"
#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/zero_phase.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::test {

/// A made-up study of the built-in arm, of which everything is known.
struct ElbowStudy {
  fit::StudyData data;
  std::vector<muscle::HillParameters<double>> truth;
  double delay_s = 0.0;
};

struct ElbowStudyOptions {
  int trials = 3;
  double seconds = 20.0;
  double rate_hz = 100.0;
  double delay_s = 0.05;
  double emg_cv = 0.0;            ///< Multiplicative noise of the activations, below 6 Hz.
  double torque_sd_nm = 0.0;      ///< Noise of the torque, below 6 Hz.
  bool truth_from_prior = false;  ///< Truth drawn from the priors about the start, otherwise a
                                  ///< fixed deviation of 10-20 %.
  bool with_priors = false;
  std::uint64_t seed = 1;
  bool with_motion = false;     ///< Angles, rates and accelerations are known.
  double true_arm_scale = 1.0;  ///< The person's moment arms over the study's.
};

/// Length and moment arm of a muscle whose moment arm is `scale` times the path's; the length at 1.18 rad stays.
inline body::MuscleTravel scaled_travel(const body::PlanarMuscle& path, double q, double scale) {
  body::MuscleTravel travel = body::travel(path, q);
  const double middle = body::travel(path, 1.18).length_m;
  travel.length_m = middle + scale * (travel.length_m - middle);
  travel.moment_arm_m *= scale;
  return travel;
}

class StudyNoise {
 public:
  explicit StudyNoise(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  double normal() { return std::sqrt(-2.0 * std::log(1.0 - uniform())) * std::cos(2.0 * kPi * uniform()); }
  /// Unit variance, below `cutoff_hz`.
  Eigen::VectorXd band(Eigen::Index count, double cutoff_hz, double rate_hz) {
    Eigen::VectorXd x(count);
    for (double& v : x) v = normal();
    x = math::zero_phase(math::design_butterworth(math::FilterBand::low_pass, 2, cutoff_hz, rate_hz), x);
    return x / std::sqrt(x.squaredNorm() / static_cast<double>(count));
  }

 private:
  std::mt19937_64 engine_;
};

/// Returns the options of a person whose muscles are drawn about the literature's, with noise of EMG and torque.
inline ElbowStudyOptions noisy_person(std::uint64_t seed) {
  return {.emg_cv = 0.1, .torque_sd_nm = 0.5, .truth_from_prior = true, .with_priors = true, .seed = seed};
}

/// Moves the EMG of a trial to later times.
inline void delay_emg(fit::TrialData& trial, double late_s) {
  const TimeSeries& emg = trial.activation;
  trial.activation = TimeSeries(emg.time_s().array() + late_s, emg.channels(), emg.values());
}

/// Four muscles whose activations rise and fall independently of each other and of the movement (two sines and a level
/// each), an elbow that moves between 10 and 125 degrees at up to some 7 rad/s, and the torque the muscles then make.
inline ElbowStudy elbow_study(const ElbowStudyOptions& o = {}) {
  ElbowStudy study;
  study.delay_s = o.delay_s;
  StudyNoise noise(o.seed);
  const body::PlanarElbow elbow = body::planar_elbow();
  const auto start = body::arm4_muscles();
  for (std::size_t k = 0; k < 4; ++k) {
    fit::MuscleSetup setup;
    setup.name = std::string(elbow.muscles[k].name);
    setup.emg_channel = setup.name;
    setup.start = start[k];
    muscle::HillParameters<double> truth = start[k];
    for (std::size_t f = 0; f < 6; ++f) {
      const muscle::HillField& field = muscle::kHillFields[f];
      const auto prior = fit::literature_prior(field.name, start[k].*field.member, start[k].optimal_fiber_length_m);
      if (o.with_priors && prior) setup.priors[std::string(field.name)] = *prior;
      double& value = truth.*field.member;
      if (o.truth_from_prior && prior) {
        const muscle::Range range = field.bounds;
        double drawn = 0.0;
        do {
          drawn =
              prior->logarithmic ? value * std::exp(prior->sd * noise.normal()) : value + prior->sd * noise.normal();
        } while (!(drawn > range.lower && drawn < range.upper));
        value = drawn;
      } else {
        // Small enough that the search finds back, too large to be taken for the start.
        const std::array<double, 6> deviation{0.2, 0.05, 0.1, 0.2, -0.15, -0.05};
        value *= 1.0 + ((k + f) % 2 == 0 ? 1.0 : -1.0) * deviation[f];
      }
    }
    study.truth.push_back(truth);
    study.data.muscles.push_back(setup);
  }
  for (int number = 0; number < o.trials; ++number) {
    fit::TrialData trial;
    trial.name = "trial" + std::to_string(number + 1);
    const auto n = static_cast<Eigen::Index>(o.seconds * o.rate_hz) + 1;
    trial.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, o.seconds);
    trial.length_m.resize(n, 4);
    trial.velocity_mps.resize(n, 4);
    trial.moment_arm_m.resize(n, 4);
    trial.force_n.resize(n, 4);
    trial.torque_nm.setZero(n);
    if (o.with_motion)
      for (Eigen::VectorXd* of : {&trial.angle_rad, &trial.velocity_radps, &trial.acceleration_radps2}) of->resize(n);
    const double w1 = 2.0 * kPi * (0.35 + 0.3 * number + 0.1 * noise.uniform());
    const double w2 = 2.0 * kPi * (1.1 + 0.2 * noise.uniform());
    const double phase = 2.0 * kPi * noise.uniform();
    const auto margin = static_cast<Eigen::Index>(0.5 * o.rate_hz);
    const Eigen::VectorXd clock = Eigen::VectorXd::LinSpaced(n + 2 * margin, -0.5, o.seconds + 0.5);
    struct Envelope {
      double level, a1, a2, w1, w2, p1, p2;
      [[nodiscard]] double at(double t) const {
        return level * (1.0 + a1 * std::sin(w1 * t + p1) + a2 * std::sin(w2 * t + p2));
      }
    };
    std::vector<Channel> channels;
    Eigen::MatrixXd recorded(clock.size(), 4);
    std::array<Envelope, 4> envelope{};
    for (std::size_t k = 0; k < 4; ++k) {
      envelope[k] = {0.15 + 0.25 * noise.uniform(),
                     0.55,
                     0.35,
                     2.0 * kPi * (0.2 + 0.5 * noise.uniform()),
                     2.0 * kPi * (0.8 + 0.8 * noise.uniform()),
                     2.0 * kPi * noise.uniform(),
                     2.0 * kPi * noise.uniform()};
      channels.push_back({study.data.muscles[k].name, Unit::dimensionless});
      const Eigen::VectorXd gain =
          o.emg_cv > 0.0 ? Eigen::VectorXd((1.0 + o.emg_cv * noise.band(clock.size(), 6.0, o.rate_hz).array()).max(0.0))
                         : Eigen::VectorXd::Ones(clock.size());
      for (Eigen::Index i = 0; i < clock.size(); ++i)
        recorded(i, static_cast<Eigen::Index>(k)) = envelope[k].at(clock[i]) * gain[i];
    }
    trial.activation = TimeSeries(clock, channels, recorded);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double t = trial.time_s[i];
      const double q = 1.18 + 0.75 * std::sin(w1 * t + phase) + 0.25 * std::sin(w2 * t);
      const double qdot = 0.75 * w1 * std::cos(w1 * t + phase) + 0.25 * w2 * std::cos(w2 * t);
      if (o.with_motion) {
        trial.angle_rad[i] = q;
        trial.velocity_radps[i] = qdot;
        trial.acceleration_radps2[i] = -0.75 * w1 * w1 * std::sin(w1 * t + phase) - 0.25 * w2 * w2 * std::sin(w2 * t);
      }
      for (std::size_t k = 0; k < 4; ++k) {
        const auto c = static_cast<Eigen::Index>(k);
        const body::MuscleTravel travel = body::travel(elbow.muscles[k], q);
        trial.length_m(i, c) = travel.length_m;
        trial.moment_arm_m(i, c) = travel.moment_arm_m;
        trial.velocity_mps(i, c) = -travel.moment_arm_m * qdot;
        const body::MuscleTravel own = scaled_travel(elbow.muscles[k], q, o.true_arm_scale);
        trial.force_n(i, c) =
            muscle::hill_force(envelope[k].at(t - o.delay_s), own.length_m - study.truth[k].tendon_slack_length_m,
                               -own.moment_arm_m * qdot, study.truth[k]);
        trial.torque_nm[i] += own.moment_arm_m * trial.force_n(i, c);
      }
    }
    if (o.torque_sd_nm > 0.0) trial.torque_nm += o.torque_sd_nm * noise.band(n, 6.0, o.rate_hz);
    study.data.trials.push_back(std::move(trial));
  }
  return study;
}

/// That a parameter is to be found, of these owners or of all.
inline fit::ParameterRule freed(const char* parameter, std::vector<std::string> owners = {}) {
  fit::ParameterRule rule;
  rule.parameter = parameter;
  rule.owners = std::move(owners);
  rule.free = true;
  return rule;
}

}  // namespace myoid::test
