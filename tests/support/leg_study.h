#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/hill_muscle.h"

#include "tests/support/elbow_study.h"

namespace myoid::test {

/// A muscle of the made-up leg: its moment arm at each joint is arm + bend sin q [m].
struct LegMuscle {
  const char* name;
  double max_force_n, fiber_length_m, slack_m;
  std::array<double, 2> arm_m, bend_m;  ///< Ankle, knee.
};

inline constexpr std::array<LegMuscle, 5> kLegMuscles{{
    {"SOL", 3000.0, 0.050, 0.25, {-0.045, 0.0}, {0.010, 0.0}},
    {"GAS", 1600.0, 0.060, 0.38, {-0.045, -0.022}, {0.010, 0.006}},
    {"TA", 900.0, 0.100, 0.22, {0.040, 0.0}, {0.008, 0.0}},
    {"VAS", 4000.0, 0.090, 0.20, {0.0, 0.040}, {0.0, -0.010}},
    {"HAM", 2200.0, 0.110, 0.33, {0.0, -0.035}, {0.0, -0.010}},
}};

inline constexpr std::array<double, 2> kLegMiddle{0.0, -0.7};  // rad: ankle, knee

struct LegStudyOptions {
  int trials = 2;
  double seconds = 12.0;
  double emg_cv = 0.0;        ///< Multiplicative noise of the envelopes, below 6 Hz.
  double torque_sd_nm = 0.0;  ///< Noise of each joint's torque, below 6 Hz.
  bool bent = true;           ///< False: the moment arms are constant.
  std::uint64_t seed = 1;
};

/// The length that a joint makes of a muscle, -∫ r dq.
inline double leg_part_m(const LegMuscle& of, std::size_t joint, double q, bool bent) {
  return -of.arm_m[joint] * q + (bent ? of.bend_m[joint] * (std::cos(q) - 1.0) : 0.0);
}

/// Setups and truth of the leg's muscles.
inline void add_leg_muscles(ElbowStudy& study) {
  const std::array<double, 4> deviation{0.2, 0.05, 0.1, 0.2};
  for (std::size_t k = 0; k < kLegMuscles.size(); ++k) {
    const LegMuscle& of = kLegMuscles[k];
    fit::MuscleSetup setup;
    setup.name = setup.emg_channel = of.name;
    setup.start = {.max_isometric_force_n = of.max_force_n,
                   .optimal_fiber_length_m = of.fiber_length_m,
                   .force_length_width_m = 0.45 * of.fiber_length_m,
                   .concentric_curvature = 0.28,
                   .eccentric_curvature_product = 0.12,
                   .eccentric_plateau = 1.4,
                   .max_shortening_speed_mps = 10.0 * of.fiber_length_m,
                   .tendon_slack_length_m = of.slack_m};
    setup.priors = fit::literature_priors(setup.start);
    setup.priors.erase("eccentric_slope_ratio");
    setup.fixed = {"max_shortening_speed", "tendon_slack_length"};
    study.truth.push_back(setup.start);
    for (std::size_t f = 0; f < deviation.size(); ++f)
      study.truth.back().*muscle::kHillFields[f].member *= 1.0 + ((k + f) % 2 == 0 ? 1.0 : -1.0) * deviation[f];
    study.data.muscles.push_back(std::move(setup));
  }
}

/// Angle and rate of ankle and knee.
struct LegMotion {
  std::array<Eigen::VectorXd, 2> q, rate;
};

inline LegMotion leg_motion(const Eigen::VectorXd& time_s, int number, StudyNoise& noise) {
  LegMotion motion;
  for (std::size_t j = 0; j < 2; ++j) {
    const double slow = 2.0 * kPi * (0.4 + 0.2 * noise.uniform() + 0.2 * number);
    const double fast = 2.0 * kPi * (1.1 + 0.2 * noise.uniform()), phase = 6.0 * noise.uniform();
    const double size = j == 0 ? 0.3 : 0.6;
    const Eigen::ArrayXd a = slow * time_s.array() + phase, b = fast * time_s.array();
    motion.q[j] = kLegMiddle[j] + size * (0.8 * a.sin() + 0.2 * b.sin());
    motion.rate[j] = size * (0.8 * slow * a.cos() + 0.2 * fast * b.cos());
  }
  return motion;
}

/// Fills lengths, rates, moment arms and forces of muscle k, whose activation is `envelope`(t).
template <typename Envelope>
void add_leg_force(const ElbowStudy& study,
                   const LegMotion& motion,
                   std::size_t k,
                   bool bent,
                   const Envelope& envelope,
                   fit::TrialData& trial) {
  const LegMuscle& of = kLegMuscles[k];
  const auto column = static_cast<Eigen::Index>(k);
  const muscle::HillParameters<double>& truth = study.truth[k];
  for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
    double length = of.slack_m + of.fiber_length_m, velocity = 0.0;
    for (std::size_t j = 0; j < 2; ++j) {
      const double q = motion.q[j][i];
      const double arm = of.arm_m[j] + (bent ? of.bend_m[j] * std::sin(q) : 0.0);
      (j == 0 ? trial.moment_arm_m : trial.more_joints[0].moment_arm_m)(i, column) = arm;
      length += leg_part_m(of, j, q, bent) - leg_part_m(of, j, kLegMiddle[j], bent);
      velocity -= arm * motion.rate[j][i];
    }
    trial.length_m(i, column) = length;
    trial.velocity_mps(i, column) = velocity;
    trial.force_n(i, column) = muscle::hill_force(envelope(trial.time_s[i] - study.delay_s),
                                                  length - truth.tendon_slack_length_m, velocity, truth);
  }
}

inline fit::TrialData leg_trial(const ElbowStudy& study, const LegStudyOptions& o, int number, StudyNoise& noise) {
  constexpr double kRate_hz = 100.0;
  constexpr auto kMuscles = static_cast<Eigen::Index>(kLegMuscles.size());
  fit::TrialData trial;
  trial.name = "trial" + std::to_string(number + 1);
  const auto n = static_cast<Eigen::Index>(o.seconds * kRate_hz) + 1;
  trial.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, o.seconds);
  trial.joint = "ankle";
  trial.more_joints.push_back({.joint = "knee"});
  fit::JointData& knee = trial.more_joints.front();
  for (Eigen::MatrixXd* of :
       {&trial.length_m, &trial.velocity_mps, &trial.moment_arm_m, &trial.force_n, &knee.moment_arm_m})
    of->setZero(n, kMuscles);
  const LegMotion motion = leg_motion(trial.time_s, number, noise);
  const Eigen::VectorXd clock = Eigen::VectorXd::LinSpaced(n + 100, -0.5, o.seconds + 0.5);
  std::vector<Channel> channels;
  Eigen::MatrixXd recorded(clock.size(), kMuscles);
  for (std::size_t k = 0; k < kLegMuscles.size(); ++k) {
    channels.push_back({kLegMuscles[k].name, Unit::dimensionless});
    const double level = 0.15 + 0.2 * noise.uniform(), w1 = 1.3 + 3.0 * noise.uniform(),
                 w2 = 5.0 + 5.0 * noise.uniform(), p1 = 6.0 * noise.uniform(), p2 = 6.0 * noise.uniform();
    const auto envelope = [&](double t) {
      return level * (1.0 + 0.55 * std::sin(w1 * t + p1) + 0.35 * std::sin(w2 * t + p2));
    };
    recorded.col(static_cast<Eigen::Index>(k)) = clock.unaryExpr(envelope);
    if (o.emg_cv > 0.0)
      recorded.col(static_cast<Eigen::Index>(k)).array() *=
          (1.0 + o.emg_cv * noise.band(clock.size(), 6.0, kRate_hz).array()).max(0.0);
    add_leg_force(study, motion, k, o.bent, envelope, trial);
  }
  trial.activation = TimeSeries(clock, channels, recorded);
  trial.torque_nm = trial.moment_arm_m.cwiseProduct(trial.force_n).rowwise().sum();
  knee.torque_nm = knee.moment_arm_m.cwiseProduct(trial.force_n).rowwise().sum();
  for (Eigen::VectorXd* torque : {&trial.torque_nm, &knee.torque_nm}) {
    if (o.torque_sd_nm > 0.0) *torque += o.torque_sd_nm * noise.band(n, 6.0, kRate_hz);
  }
  trial.angle_rad = motion.q[0];
  trial.velocity_radps = motion.rate[0];
  knee.angle_rad = motion.q[1];
  knee.velocity_radps = motion.rate[1];
  trial.acceleration_radps2 = knee.acceleration_radps2 = Eigen::VectorXd::Zero(n);
  return trial;
}

/// Ankle and knee with five muscles, of which GAS crosses both; the activations rise and fall
/// independently, the joints move independently, and the torques are those that the muscles then
/// make. The truth is 5 to 20 % away from the start; priors are the literature's.
inline ElbowStudy leg_study(const LegStudyOptions& o = {}) {
  ElbowStudy study;
  study.delay_s = 0.05;
  StudyNoise noise(o.seed);
  add_leg_muscles(study);
  for (int number = 0; number < o.trials; ++number) study.data.trials.push_back(leg_trial(study, o, number, noise));
  return study;
}

}  // namespace myoid::test
