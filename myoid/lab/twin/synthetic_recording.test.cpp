#include "myoid/lab/twin/synthetic_recording.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::lab {
namespace {

/// A little of everything, quick to generate.
Protocol small_protocol(Level level) {
  Protocol protocol = parse_protocol(R"(
[[trial]]
name = "mvc"
kind = "mvc"
direction = "flexion"
hold_s = 4.0
[[trial]]
name = "ramp"
kind = "isometric_ramp"
angle_deg = 60
[[trial]]
name = "loaded"
kind = "flexion"
held_mass_kg = 2.0
frequency_hz = 0.5
duration_s = 6
[[trial]]
name = "flat"
kind = "flexion"
plane = "horizontal"
duration_s = 5
[[trial]]
name = "relaxed"
kind = "passive"
)",
                                     "test.toml");
  protocol.level = level;
  return protocol;
}

const VirtualTrial& trial(const VirtualRecording& recording, const std::string& name) {
  for (const VirtualTrial& candidate : recording.trials) {
    if (candidate.protocol.name == name) return candidate;
  }
  throw InvalidInput("no trial " + name);
}

TEST(VirtualRecording, MusclesExertTheTorqueThatTheMotionRequires) {
  const VirtualRecording recording = make_virtual_recording(small_protocol(Level::noise_free), 1);
  // An oracle apart from the generator: the pendulum by hand, from the numbers of de Leva.
  const double forearm_kg = 0.0162 * 73.0;
  const double hand_kg = 0.0061 * 73.0;
  const double hand_at_m = 0.2689 + 0.79 * 0.0862;
  const double inertia = forearm_kg * std::pow(0.2689, 2) * (std::pow(0.4574, 2) + std::pow(0.265, 2)) +
                         hand_kg * (hand_at_m * hand_at_m + std::pow(0.513 * 0.0862, 2));
  const double moment = forearm_kg * 0.4574 * 0.2689 + hand_kg * hand_at_m;
  for (const VirtualTrial& t : recording.trials) {
    const double mass_kg = t.protocol.held_mass_kg;
    const double g = t.protocol.plane == Plane::vertical ? 9.80665 : 0.0;
    for (Eigen::Index k = 0; k < t.truth.motion.sample_count(); ++k) {
      const double q = t.truth.motion.values()(k, 0);
      const double qddot = t.truth.motion.values()(k, 2);
      const double required_nm =
          (inertia + mass_kg * hand_at_m * hand_at_m) * qddot + (moment + mass_kg * hand_at_m) * g * std::sin(q);
      // Round-off of terms up to 100 N m.
      ASSERT_NEAR(t.truth.torque.values().row(k).sum(), required_nm, 1e-12) << t.protocol.name;
    }
  }
}

TEST(VirtualRecording, ForcesTimesMomentArmsAreTheTorque) {
  const VirtualRecording recording = make_virtual_recording(small_protocol(Level::noise_free), 1);
  const VirtualTrial& t = trial(recording, "loaded");
  const auto elbow = body::planar_elbow();
  for (Eigen::Index k = 10; k < t.truth.motion.sample_count() - 10; k += 7) {
    const double h = 1e-6;
    double torque_nm = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      // Moment arms by differences of the length: 1e-16/h, times forces of up to 1000 N.
      const double q = t.truth.motion.values()(k, 0);
      const double arm_m =
          (body::travel(elbow.muscles[i], q - h).length_m - body::travel(elbow.muscles[i], q + h).length_m) / (2 * h);
      torque_nm += arm_m * t.truth.force.values()(k, static_cast<Eigen::Index>(i));
    }
    EXPECT_NEAR(torque_nm, t.truth.torque.values()(k, 0), 1e-6);
  }
}

TEST(VirtualRecording, TheElectrodeSeesTheActivationEarlierByTheDelay) {
  const VirtualRecording recording = make_virtual_recording(small_protocol(Level::noise_free), 3);
  const double delay_s = recording.truth.emg_delay_s;
  EXPECT_GE(delay_s, 0.0295);
  EXPECT_LE(delay_s, 0.0805);
  EXPECT_NEAR(delay_s * 1000.0, std::round(delay_s * 1000.0), 1e-9);
  const VirtualTrial& t = trial(recording, "loaded");
  const auto lag = static_cast<Eigen::Index>(std::lround(delay_s * 1000.0));
  for (Eigen::Index k = 10; k < t.truth.activation.sample_count(); k += 3) {
    // Motion at 100 Hz, EMG at 1000: the same instants, up to the round-off of their clocks.
    EXPECT_NEAR(t.emg.column("BIC")(10 * k - lag), t.truth.activation.column("BIC")(k), 1e-12);
    EXPECT_NEAR(t.emg.column("TRI")(10 * k - lag), t.truth.activation.column("TRI")(k), 1e-12);
  }
}

TEST(VirtualRecording, BrachialisSharesTheBicepsOrHasItsOwnElectrode) {
  Protocol protocol = small_protocol(Level::noise_free);
  const VirtualRecording shared = make_virtual_recording(protocol, 1);
  EXPECT_FALSE(shared.trials[0].emg.find("BRA").has_value());
  const TimeSeries& a = trial(shared, "loaded").truth.activation;
  EXPECT_EQ(a.column("BRA"), a.column("BIC"));
  protocol.control.brachialis_synergy = 0.3;
  const VirtualRecording own = make_virtual_recording(protocol, 1);
  EXPECT_TRUE(own.trials[0].emg.find("BRA").has_value());
  const TimeSeries& b = trial(own, "loaded").truth.activation;
  EXPECT_GT((b.column("BRA") - b.column("BIC")).cwiseAbs().maxCoeff(), 0.01);
}

TEST(VirtualRecording, BrachioradialisIsNotTheBicepsTwice) {
  const VirtualRecording recording = make_virtual_recording(small_protocol(Level::noise_free), 1);
  const TimeSeries& a = trial(recording, "ramp").truth.activation;
  const TimeSeries& b = trial(recording, "loaded").truth.activation;
  const double of_ramp = a.column("BRD")(350) / a.column("BIC")(350);
  const double of_loaded = b.column("BRD")(300) / b.column("BIC")(300);
  EXPECT_GT(std::abs(std::log(of_ramp / of_loaded)), 0.01);
}

TEST(VirtualRecording, ActivationsArePossible) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const VirtualRecording recording = make_virtual_recording(small_protocol(Level::noise_free), seed);
    for (const VirtualTrial& t : recording.trials) {
      EXPECT_GE(t.truth.activation.values().minCoeff(), 0.0);
      EXPECT_LE(t.truth.activation.values().maxCoeff(), 1.0);
    }
  }
}

TEST(VirtualRecording, SameSeedSameRecordingOtherSeedAnother) {
  const VirtualRecording a = make_virtual_recording(small_protocol(Level::noisy), 5);
  const VirtualRecording b = make_virtual_recording(small_protocol(Level::noisy), 5);
  const VirtualRecording c = make_virtual_recording(small_protocol(Level::noisy), 6);
  for (std::size_t k = 0; k < a.trials.size(); ++k) {
    EXPECT_EQ(a.trials[k].emg.values(), b.trials[k].emg.values());
    EXPECT_EQ(a.trials[k].markers.positions_m, b.trials[k].markers.positions_m);
    EXPECT_NE(a.trials[k].emg.values(), c.trials[k].emg.values());
  }
  EXPECT_NE(a.truth.muscles[0].max_isometric_force_n, c.truth.muscles[0].max_isometric_force_n);
}

TEST(VirtualRecording, RawEmgOfTheGreatestEffortHasItsRms) {
  const VirtualRecording recording = make_virtual_recording(small_protocol(Level::noisy), 2);
  const VirtualTrial& t = trial(recording, "mvc");
  EXPECT_EQ(t.emg.channels()[0].unit, Unit::volt);
  // Rest 1 s, rise 1 s, hold 4 s: samples of the plateau. Rms over 3.8 s of 200 Hz bandwidth:
  // standard error 1/sqrt(4 x 200 x 3.8) = 1.8 %; mains and amplifier add 0.02 %.
  const Eigen::VectorXd plateau = t.emg.column("BIC").segment(2000, 3800);
  EXPECT_NEAR(std::sqrt(plateau.squaredNorm() / 3800.0) / recording.truth.instruments.greatest_v[kBiceps], 1.0, 0.075);
  // Its rectified mean, which the study normalises by: sqrt(2/pi) of that.
  EXPECT_NEAR(plateau.cwiseAbs().mean() / recording.truth.instruments.greatest_v[kBiceps], std::sqrt(2.0 / kPi), 0.06);
  // At rest: 1.5 % of it from the amplifier and 1 % of mains.
  const Eigen::VectorXd rest = t.emg.column("BIC").head(800);
  EXPECT_NEAR(std::sqrt(rest.squaredNorm() / 800.0) / recording.truth.instruments.greatest_v[kBiceps],
              std::hypot(0.015, 0.010), 0.003);
}

TEST(VirtualRecording, TheDynamometerTakesWhatTheMusclesExertAndHoldsTheForearm) {
  const VirtualRecording recording = make_virtual_recording(small_protocol(Level::noise_free), 4);
  const VirtualTrial& t = trial(recording, "ramp");
  ASSERT_TRUE(t.external_torque.has_value());
  const double weight_nm = body::planar_elbow().static_moment_kgm * kStandardGravity * std::sin(60.0 * kDegree);
  const Eigen::VectorXd external_nm = t.external_torque->column("elbow_flexion_moment");
  EXPECT_NEAR(external_nm(0), weight_nm, 1e-12);  // at rest it carries the weight: flexes
  EXPECT_LT(external_nm.minCoeff(), -5.0);        // it resists flexion: negative
  EXPECT_NEAR(external_nm(350) + t.truth.torque.values()(350, 0), weight_nm, 1e-12);
  EXPECT_FALSE(trial(recording, "loaded").external_torque.has_value());
  EXPECT_EQ(trial(recording, "relaxed").truth.activation.values().maxCoeff(), 0.0);
}

TEST(VirtualRecording, TorqueNoiseHasTheSpreadAskedFor) {
  const VirtualRecording noisy = make_virtual_recording(small_protocol(Level::noisy), 4);
  const VirtualTrial& t = trial(noisy, "ramp");
  const Eigen::VectorXd error_nm = t.external_torque->column("elbow_flexion_moment") - t.truth.torque.values().col(1);
  // 13 s of noise with 2 x 3.9 Hz: about 100 values, 7 % each way; four of them.
  EXPECT_NEAR(std::sqrt(error_nm.squaredNorm() / static_cast<double>(error_nm.size())), 0.3, 0.09);
}

TEST(VirtualRecording, ATrialBeyondAnyonesStrengthIsRefusedByName) {
  Protocol protocol = small_protocol(Level::noise_free);
  protocol.trials[2].held_mass_kg = 50.0;
  try {
    static_cast<void>(make_virtual_recording(protocol, 1));
    FAIL() << "expected InvalidInput";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("\"loaded\""), std::string::npos) << error.what();
  }
}

TEST(VirtualRecording, WithoutSpreadThePersonIsTheLiterature) {
  Protocol protocol = small_protocol(Level::noise_free);
  protocol.truth.spread = 0.0;
  protocol.truth.values["BRA"]["optimal_fiber_length"] = 0.09;
  const HillSet& found = make_virtual_recording(protocol, 1).truth.muscles;
  const auto expected = body::arm4_muscles();
  EXPECT_EQ(found[kBiceps].max_isometric_force_n, expected[kBiceps].max_isometric_force_n);
  // The product goes through the ratio of slopes and back: round-off.
  EXPECT_NEAR(found[kTriceps].eccentric_curvature_product, expected[kTriceps].eccentric_curvature_product, 1e-15);
  EXPECT_EQ(found[kBrachialis].optimal_fiber_length_m, 0.09);
}

}  // namespace
}  // namespace myoid::lab
