#include "myoid/simulation/identification_ready.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/muscle/hill_muscle.h"
#include "myoid/signals/resample.h"

namespace myoid::simulation {
namespace {

Protocol protocol(Level level) {
  return parse_protocol(R"(
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
hold_s = 3.0
[[trial]]
name = "loaded"
kind = "flexion"
held_mass_kg = 2.0
frequency_hz = 0.5
duration_s = 8
[[trial]]
name = "ramp"
kind = "isometric_ramp"
angle_deg = 60
)",
                        "test.toml", level);
}

TEST(IdentificationReady, ExactRecordingsGiveTorquesThatTheTrueMusclesExert) {
  const ReadyPerson person = make_identification_ready(protocol(Level::noise_free), 3);
  ASSERT_EQ(person.trials.size(), 2u);  // without the MVC
  for (const ReadyTrial& trial : person.trials) {
    EXPECT_TRUE(trial.calibration);
    // Away from the ends, where the delay reaches before the beginning.
    constexpr Eigen::Index kMargin = 30;
    const Eigen::Index count = trial.time_s.size() - 2 * kMargin;
    const TimeSeries activation = signals::resample(
        trial.activation,
        (trial.time_s.segment(kMargin, count).array() - person.truth.emg_delay_s).matrix());
    double worst_nm = 0.0;
    double largest_nm = 0.0;
    for (Eigen::Index row = 0; row < count; ++row) {
      const Eigen::Index k = row + kMargin;
      double torque_nm = 0.0;
      for (std::size_t m = 0; m < 4; ++m) {
        const auto c = static_cast<Eigen::Index>(m);
        const muscle::HillParameters<double>& p = person.truth.muscles[m];
        const double a = activation.values()(row, activation.index(person.channels[m]));
        torque_nm += trial.moment_arm_m(k, c) *
                     muscle::hill_force(a, trial.length_m(k, c) - p.tendon_slack_length_m,
                                        trial.velocity_mps(k, c), p);
      }
      worst_nm = std::max(worst_nm, std::abs(torque_nm - trial.torque_nm(k)));
      largest_nm = std::max(largest_nm, std::abs(trial.torque_nm(k)));
    }
    // Derivatives of exact markers at 100 Hz by quintic splines, on 8 s of 0.5 Hz.
    EXPECT_LT(worst_nm, 1e-3 * largest_nm) << trial.name;
    EXPECT_GT(largest_nm, 5.0);
  }
}

TEST(IdentificationReady, AtL2TorqueAndEnvelopeAreNearTheTruthAndNotIt) {
  const VirtualRecording recording = make_virtual_recording(protocol(Level::different), 3);
  const ReadyPerson person = identification_ready(recording);
  EXPECT_EQ(person.normalisation.size(), 3u);
  EXPECT_EQ(person.channels[kBrachialis], "BIC");
  const ReadyTrial& trial = person.trials.front();
  const TimeSeries truth = signals::resample(recording.trials[1].truth.torque, trial.time_s);
  const Eigen::VectorXd muscles = truth.column("elbow_flexion_moment");
  const double error_nm =
      std::sqrt((trial.torque_nm - muscles).squaredNorm() / static_cast<double>(muscles.size()));
  const double range_nm = muscles.maxCoeff() - muscles.minCoeff();
  // Inertia 10 % off, angles by skin and misplaced markers, passive torque of the joint.
  EXPECT_LT(error_nm, 0.35 * range_nm);
  EXPECT_GT(error_nm, 0.002 * range_nm);
  EXPECT_GT(trial.activation.values().maxCoeff(), 0.05);
  EXPECT_LT(trial.activation.values().maxCoeff(), 1.2);
}

}  // namespace
}  // namespace myoid::simulation
