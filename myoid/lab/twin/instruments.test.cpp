#include "myoid/lab/twin/instruments.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/lab/twin/synthetic_recording.h"

namespace myoid::lab {
namespace {

/// A protocol at L1 in which nothing disturbs but what a test switches on.
Protocol quiet(const std::string& trials) {
  Protocol protocol = parse_protocol(trials, "test.toml", Level::noisy);
  protocol.motion.marker_sd_m = 0.0;
  protocol.emg.baseline = protocol.emg.hum = protocol.emg.artefact = 0.0;
  protocol.torque.sd_nm = 0.0;
  return protocol;
}

const std::string kSwing =
    "[[trial]]\nname = \"swing\"\nkind = \"flexion\"\nfrequency_hz = 0.5\nduration_s = 20\n"
    "held_mass_kg = 2\n";
const std::string kHold = "[[trial]]\nname = \"hold\"\nkind = \"mvc\"\ndirection = \"flexion\"\nhold_s = 40\n";

/// Amplitude of the sine of this frequency in a signal (rms), by its Fourier sum.
double rms_at(const Eigen::VectorXd& signal, double frequency_hz, double rate_hz) {
  std::complex<double> sum = 0.0;
  for (Eigen::Index k = 0; k < signal.size(); ++k)
    sum += signal(k) * std::polar(1.0, -2.0 * kPi * frequency_hz * static_cast<double>(k) / rate_hz);
  return std::sqrt(2.0) * std::abs(sum) / static_cast<double>(signal.size());
}

double rms(const Eigen::VectorXd& v) { return std::sqrt(v.squaredNorm() / static_cast<double>(v.size())); }

TEST(Instruments, MainsHumHasItsRmsAndFrequency) {
  Protocol protocol = quiet("[[trial]]\nname = \"rest\"\nkind = \"passive\"\nraise_s = 8\nlower_s = 8\n");
  protocol.emg.hum = 0.03;
  protocol.emg.hum_hz = 60.0;
  const VirtualRecording r = make_virtual_recording(protocol, 3);
  // 18 s: a whole number of periods, and the muscles are silent. Steps of 0.1 uV blur 1e-3 of it.
  const Eigen::VectorXd signal = r.trials[0].emg.column("TRI").head(18000);
  const double greatest = r.truth.instruments.greatest_v[kTriceps];
  EXPECT_NEAR(rms_at(signal, 60.0, 1000.0) / greatest, 0.03, 3e-5);
  EXPECT_NEAR(rms(signal) / greatest, 0.03, 3e-5);
  EXPECT_LT(rms_at(signal, 50.0, 1000.0) / greatest, 1e-5);
}

TEST(Instruments, TheArtefactOfMovementLiesBelow15HzAndGrowsWithSpeed) {
  Protocol protocol = quiet(
      "[[trial]]\nname = \"rest\"\nkind = \"passive\"\nraise_s = 2\nlower_s = 2\nrepetitions = "
      "20\n");
  protocol.emg.artefact = 0.05;
  const VirtualRecording r = make_virtual_recording(protocol, 3);
  const VirtualTrial& t = r.trials[0];
  const Eigen::VectorXd signal = t.emg.column("TRI") / r.truth.instruments.greatest_v[kTriceps];
  // Its rms follows |qdot| / 2 rad/s.
  double expected = 0.0;
  const Eigen::VectorXd speed = t.truth.motion.values().col(1);
  expected = 0.05 / 2.0 * rms(speed);
  EXPECT_NEAR(rms(signal) / expected, 1.0, 0.15);  // 120 s of 8 Hz: 3 %; moving a third of the time
  // Every eighth sample will do for what falls with the fourth power of frequency.
  const Eigen::VectorXd thin = signal(Eigen::seq(0, signal.size() - 1, 8));
  double below = 0.0;
  double above = 0.0;
  for (int k = 1; k <= 240; ++k) {
    const double f = 0.25 * k;
    const double part = rms_at(thin, f, 125.0);
    (f < 15.0 ? below : above) += part * part;
  }
  // Of two lags at 4 Hz 1.1 % lies above 15 Hz; below it are some 20 lines that count: 20 %.
  EXPECT_LT(above, 0.02 * below);
}

TEST(Instruments, CrosstalkIsTheNeighboursOwnSignal) {
  Protocol protocol = quiet(kHold);
  protocol.control.brachialis_synergy = 0.3;
  const VirtualRecording without = make_virtual_recording(protocol, 5);
  protocol.emg.crosstalk = {0.08, 0.08};
  const VirtualRecording with = make_virtual_recording(protocol, 5);
  const auto& greatest = with.truth.instruments.greatest_v;
  // The same seed: the same muscles' signals. What was added is 8 % of the neighbour's.
  const auto channel = [](const VirtualRecording& r, const char* name) -> Eigen::VectorXd {
    return r.trials[0].emg.column(name);
  };
  const Eigen::VectorXd added = (channel(with, "BIC") - channel(without, "BIC")) / greatest[kBiceps];
  const Eigen::VectorXd source = channel(without, "BRA") / greatest[kBrachialis];
  EXPECT_LT((added - 0.08 * source).cwiseAbs().maxCoeff(), 1e-3);  // 0.1 uV of 0.3 mV
  EXPECT_EQ(channel(with, "TRI"), channel(without, "TRI"));
  const Eigen::VectorXd wrist = (channel(with, "BRD") - channel(without, "BRD")) / greatest[kBrachioradialis];
  EXPECT_NEAR(rms(wrist.segment(5000, 30000)), 0.08 * 0.5, 0.004);  // half of the biceps' effort
}

TEST(Instruments, AnExponentBendsTheAmplitudeAndNothingElse) {
  Protocol protocol = quiet(
      "[[trial]]\nname = \"hold\"\nkind = \"isometric_ramp\"\ndirection = \"extension\"\npeak = "
      "0.25\nhold_s = 60\n");
  protocol.emg.exponent = {1.4, 1.4};
  const VirtualRecording r = make_virtual_recording(protocol, 2);
  const Eigen::VectorXd plateau =
      r.trials[0].emg.column("TRI").segment(4000, 56000) / r.truth.instruments.greatest_v[kTriceps];
  // 56 s of 200 Hz: 1 / sqrt(4 x 200 x 56) = 0.5 %.
  EXPECT_NEAR(rms(plateau) / std::pow(0.25, 1.0 / 1.4), 1.0, 0.02);
}

/// Frequency that halves the power between 5 and 400 Hz, by Fourier sums.
double median_hz(const Eigen::VectorXd& signal, double rate_hz) {
  std::vector<double> power;
  double total = 0.0;
  for (int f = 5; f <= 400; ++f) {
    double sum = 0.0;
    // Segments of a second, so that every line is an average.
    for (Eigen::Index start = 0; start + 1000 <= signal.size(); start += 1000)
      sum += std::pow(rms_at(signal.segment(start, 1000), f, rate_hz), 2);
    total += power.emplace_back(sum);
  }
  double below = 0.0;
  for (std::size_t k = 0; k < power.size(); ++k) {
    below += power[k];
    if (below > 0.5 * total) return 5.0 + static_cast<double>(k);
  }
  return 0.0;
}

TEST(Instruments, FatigueLowersTheFrequenciesWhileATrialLasts) {
  // The whole of a trial of 100 s of the elbow's flexors, at a rate of fatigue that takes a third.
  Protocol protocol = quiet(
      "[[trial]]\nname = \"hold\"\nkind = \"isometric_ramp\"\ndirection = \"flexion\"\npeak = "
      "0.5\nhold_s = 100\n");
  protocol.fatigue = {.on = true, .rates = "elbow"};
  const VirtualRecording r = make_virtual_recording(protocol, 2);
  const Eigen::VectorXd emg = r.trials[0].emg.column("BIC");
  const TimeSeries& state = r.trials[0].truth.state;
  const auto fresh_share = [&](double t) {
    return 1.0 - state.values()(static_cast<Eigen::Index>(100.0 * t), state.index("fatigued_BIC"));
  };
  const double early = median_hz(emg.segment(3000, 10000), 1000.0);
  const double late = median_hz(emg.segment(92000, 10000), 1000.0);
  EXPECT_LT(fresh_share(97.0), 0.8);
  // 10 s and 150 Hz: the median of 1500 values, 3 %.
  EXPECT_NEAR(late / early, fresh_share(97.0) / fresh_share(8.0), 0.08);
}

TEST(Instruments, AChannelHasItsOwnFrequenciesAndTheAmplifierItsBandwidth) {
  Protocol protocol = quiet(kHold);
  protocol.emg.rate_hz = 2000.0;
  protocol.emg.spectrum = {0.6, 0.6};
  const VirtualRecording slow = make_virtual_recording(protocol, 2);
  protocol.emg.bandwidth_hz = 300.0;
  const VirtualRecording narrow = make_virtual_recording(protocol, 2);
  const auto plateau = [](const VirtualRecording& recording) -> Eigen::VectorXd {
    return recording.trials[0].emg.column("BIC").segment(10000, 20000);
  };
  // The median of Shwedyk's spectrum at 60 and 120 Hz is 92 Hz.
  EXPECT_NEAR(median_hz(plateau(slow), 2000.0), 0.6 * 92.0, 4.0);
  const auto at = [&](const VirtualRecording& recording, double f) {
    double sum = 0.0;
    for (int k = -20; k <= 20; ++k) sum += std::pow(rms_at(plateau(recording), f + k, 2000.0), 2);
    return sum;
  };
  // A Butterworth filter of fourth order: half the power at its cut-off, 1/257 at twice that (but
  // for the bilinear transform, which takes more).
  EXPECT_NEAR(at(narrow, 300.0) / at(slow, 300.0), 0.5, 0.1);
  EXPECT_NEAR(at(narrow, 60.0) / at(slow, 60.0), 1.0, 0.01);
  // ... and steps of 0.1 uV are 1 % of the little that is there.
  EXPECT_LT(at(narrow, 600.0) / at(slow, 600.0), 1.0 / 257.0 + 0.02);
}

TEST(Instruments, AnMvcThatFallsShortIsSmallerInEmgAndTorque) {
  Protocol protocol = quiet(kHold);
  protocol.emg.effort = {0.8, 0.8};
  const VirtualRecording r = make_virtual_recording(protocol, 2);
  const Eigen::VectorXd plateau =
      r.trials[0].emg.column("BIC").segment(5000, 30000) / r.truth.instruments.greatest_v[kBiceps];
  EXPECT_NEAR(rms(plateau), 0.8, 0.03);
  EXPECT_NEAR(r.trials[0].truth.activation.column("BIC").maxCoeff(), 0.8, 1e-12);
}

TEST(Instruments, SkinMovesAsASineOfTheAngleWithThePublishedAmplitude) {
  Protocol protocol = quiet(kSwing);
  protocol.motion.soft_tissue = 1.0;
  const VirtualRecording moved = make_virtual_recording(protocol, 4);
  protocol.motion.soft_tissue = 0.0;
  const VirtualRecording still = make_virtual_recording(protocol, 4);
  const VirtualArm arm(protocol.subject);
  const auto segments = arm.marker_segments();
  const Eigen::VectorXd q = still.trials[0].truth.motion.values().col(0);
  for (std::size_t m = 0; m < segments.size(); ++m) {
    const auto c = static_cast<Eigen::Index>(3 * m);
    const Eigen::MatrixXd off =
        moved.trials[0].markers.positions_m.middleCols(c, 3) - still.trials[0].markers.positions_m.middleCols(c, 3);
    const Eigen::VectorXd distance = off.rowwise().norm();
    const MarkerError& error = moved.truth.instruments.markers[m];
    const double size_m = error.soft_tissue_m.norm();
    if (segments[m] == MarkerSegment::trunk) {
      EXPECT_EQ(distance.maxCoeff(), 0.0);
      continue;
    }
    const bool upper = segments[m] == MarkerSegment::upper_arm;
    EXPECT_GE(size_m, upper ? 0.005 : 0.003);
    EXPECT_LE(size_m, upper ? 0.010 : 0.005);
    for (Eigen::Index k = 0; k < q.size(); k += 50)  // both are rounded to 0.01 mm
      EXPECT_NEAR(distance(k), size_m * std::abs(std::sin(q(k) + error.phase_rad)), 2e-5);
  }
}

TEST(Instruments, MarkersAreMisplacedBySoMuch) {
  Protocol protocol = quiet(kSwing);
  protocol.motion.misplacement_m = 0.005;
  const VirtualArm arm(protocol.subject);
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    for (const MarkerError& error : attach_instruments(protocol, arm, seed).markers) {
      sum += error.misplaced_m.squaredNorm();
      ++count;
    }
  }
  // More than a thousand of 3 degrees of freedom: 1 / sqrt(6 x 1000) = 1.3 %.
  EXPECT_NEAR(std::sqrt(sum / count), 0.005, 0.0003);
}

TEST(Instruments, GapsComeAsOftenAndLastAsLongAsAskedFor) {
  Protocol protocol = quiet("[[trial]]\nname = \"swing\"\nkind = \"flexion\"\nduration_s = 300\nfrequency_hz = 0.3\n");
  protocol.motion.dropouts_per_min = 4.0;
  const VirtualRecording r = make_virtual_recording(protocol, 6);
  const MarkerSeries& markers = r.trials[0].markers;
  int gaps = 0;
  int longest = 0;
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    int length = 0;
    for (Eigen::Index k = 0; k < markers.frame_count(); ++k) {
      length = markers.missing(k, m) ? length + 1 : 0;
      gaps += length == 1 ? 1 : 0;
      longest = std::max(longest, length);
    }
  }
  const double expected = 4.0 * 5.0 * static_cast<double>(markers.marker_count());
  EXPECT_NEAR(gaps / expected, 1.0,
              4.0 / std::sqrt(expected));  // Poisson, four standard deviations
  EXPECT_LE(longest, 60);                  // two that meet
}

TEST(Instruments, TheClocksDifferByTheTriggerAndTheDrift) {
  Protocol protocol = quiet(kSwing);
  protocol.sync = {.offset_sd_s = 0.008, .drift_ppm = 50.0};
  const VirtualArm arm(protocol.subject);
  double sum = 0.0;
  int drifting = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Instruments instruments = attach_instruments(protocol, arm, seed);
    const EmgClock clock = emg_clock(protocol, instruments, "swing", seed);
    sum += clock.offset_s * clock.offset_s;
    drifting += clock.drift > 0.0 ? 1 : 0;
    if (clock.drift > 0.0) {
      EXPECT_DOUBLE_EQ(clock.true_time_s(100.0), 100.005 + clock.offset_s);
    }
  }
  EXPECT_NEAR(std::sqrt(sum / 400.0), 0.008, 0.0012);  // 3.5 % standard error
  EXPECT_NEAR(drifting, 200, 40);                      // 10 standard error
}

TEST(Instruments, EmgOfADifferentClockIsTheSameSignalShifted) {
  Protocol protocol = quiet(kSwing);
  const VirtualArm arm(protocol.subject);
  Instruments instruments = attach_instruments(protocol, arm, 1);
  Tiredness<4> fresh;
  const HillSet muscles = arm.literature;
  const ExactPerformance performance(arm, muscles, make_script(protocol.trials[0], protocol.control, 1), 0.05, fresh);
  const TimeSeries on_time = record_emg(protocol, instruments, performance, {0.0, 0.0}, 1);
  const TimeSeries late = record_emg(protocol, instruments, performance, {0.1, 0.0}, 1);
  // The same noise, another amplitude: that of the drive 0.1 s later.
  for (Eigen::Index k = 3000; k < 15000; k += 10) {
    const double n = on_time.values()(k, 0) / performance.drive(0.001 * static_cast<double>(k))[0];
    const double expected = n * performance.drive(0.1 + 0.001 * static_cast<double>(k))[0];
    // Straight lines 4 ms long in place of the drive, and 0.1 uV steps of signals of 10 uV and more.
    EXPECT_NEAR(late.values()(k, 0), expected, 0.02 * std::abs(expected) + 3e-7);
  }
}

/// A line, the same in two trials of one person, leads from the fibers to what is shown.
TEST(Ultrasound, ShowsFibersByAScaleAndAnOffsetOfThePerson) {
  Protocol protocol = quiet(kSwing);
  const VirtualArm arm(protocol.subject);
  const HillSet muscles = arm.literature;
  Tiredness<4> fresh;
  const auto line_of = [&](std::uint64_t of_trial) {
    const ExactPerformance performance(arm, muscles, make_script(protocol.trials[0], protocol.control, of_trial), 0.05,
                                       fresh);
    const TimeSeries shown = record_fascicles(protocol, performance, 5.0, 7);
    EXPECT_EQ(shown.sample_count(), 151);
    Eigen::MatrixXd fiber(shown.sample_count(), 2);
    fiber.col(1).setOnes();
    for (Eigen::Index i = 0; i < fiber.rows(); ++i)
      fiber(i, 0) = performance.at(shown.time_s()[i]).fiber_length_m[kBiceps];
    const Eigen::Vector2d line = fiber.colPivHouseholderQr().solve(shown.column("BIC"));
    EXPECT_LT((fiber * line - shown.column("BIC")).cwiseAbs().maxCoeff(), 1.2e-5);  // steps of 0.01 mm
    return line;
  };
  const Eigen::Vector2d one = line_of(1), other = line_of(2);
  EXPECT_LT((one - other).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_NEAR(one[0], 1.0, 0.2);
  EXPECT_NE(one[0], 1.0);
  EXPECT_LT(std::abs(one[1]), 0.01);
}

Eigen::VectorXd channel(const VirtualRecording& r, std::size_t muscle) {
  return r.trials[0].emg.column(std::string(kArmMuscles[muscle])) / r.truth.instruments.greatest_v[muscle];
}

TEST(WrongSensors, TheDynamometerShowsScaleTimesTorqueAndOffset) {
  Protocol protocol = quiet(kHold);
  set_truth(protocol, {"torque_scale=1.05", "torque_offset_nm=-1.5"});
  const VirtualTrial trial = make_virtual_recording(protocol, 4).trials[0];
  const Eigen::VectorXd exact = trial.truth.torque.column("elbow_flexion_external_moment");
  const Eigen::VectorXd shown = trial.external_torque->column("elbow_flexion_moment");
  EXPECT_LT((shown - (1.05 * exact.array() - 1.5).matrix()).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_GT(exact.cwiseAbs().maxCoeff(), 10.0);
}

TEST(WrongSensors, CrosstalkIsAShareOfEveryOtherChannel) {
  Protocol protocol = quiet(kHold);
  protocol.control.brachialis_synergy = 0.3;
  const VirtualRecording without = make_virtual_recording(protocol, 5);
  set_truth(protocol, {"crosstalk=0.15"});
  const VirtualRecording with = make_virtual_recording(protocol, 5);
  for (std::size_t m = 0; m < 4; ++m) {
    Eigen::VectorXd expected = channel(without, m);
    for (std::size_t other = 0; other < 4; ++other)
      if (other != m) expected += 0.15 * channel(without, other);
    EXPECT_LT((channel(with, m) - expected).cwiseAbs().maxCoeff(), 1e-3);  // 0.1 uV of 0.3 mV
  }
}

TEST(WrongSensors, TheExponentIsEveryMusclesAndInTheTruth) {
  Protocol protocol = quiet(kHold);
  protocol.truth.sensors = {};
  const VirtualRecording plain = make_virtual_recording(protocol, 6);
  set_truth(protocol, {"emg_exponent=0.6"});
  const VirtualRecording bent = make_virtual_recording(protocol, 6);
  for (const double p : bent.truth.instruments.exponent) EXPECT_EQ(p, 0.6);
  // The triceps works along at a share c of the greatest effort: its amplitude is c^(1/0.6).
  const Eigen::VectorXd one = channel(plain, kTriceps).segment(3000, 38000);
  const Eigen::VectorXd other = channel(bent, kTriceps).segment(3000, 38000);
  const Eigen::VectorXd u = bent.trials[0].truth.activation.column("TRI").segment(300, 3800);
  const double expected = std::sqrt(u.array().pow(2.0 / 0.6).mean() / u.array().square().mean());
  EXPECT_NEAR(rms(other) / rms(one) / expected, 1.0, 0.1);
}

TEST(WrongSensors, TheGainGrowsEvenlyOverTheSession) {
  Protocol protocol = quiet(kHold +
                            "[[trial]]\nname = \"again\"\nkind = \"mvc\"\ndirection = "
                            "\"flexion\"\nhold_s = 40\n");
  protocol.fatigue.rest_s = 60.0;
  const VirtualRecording without = make_virtual_recording(protocol, 5);
  set_truth(protocol, {"emg_gain_drift=0.2"});
  const VirtualRecording with = make_virtual_recording(protocol, 5);
  const auto last_s = [&](std::size_t k) {
    const Eigen::VectorXd& time_s = with.trials[k].truth.motion.time_s();
    return time_s(time_s.size() - 1);
  };
  const double session_s = last_s(0) + 60.0 + last_s(1);
  for (std::size_t k = 0; k < 2; ++k) {
    const Eigen::VectorXd before = without.trials[k].emg.column("BIC");
    const Eigen::VectorXd after = with.trials[k].emg.column("BIC");
    for (Eigen::Index i = 5000; i < 35000; i += 97) {
      if (std::abs(before(i)) < 2e-4) continue;
      const double at_s = 0.001 * static_cast<double>(i) + (k == 0 ? 0.0 : last_s(0) + 60.0);
      EXPECT_NEAR(after(i) / before(i), 1.0 + 0.2 * at_s / session_s, 1e-3);  // 0.1 uV
    }
  }
}

TEST(WrongSensors, EmgThatIsNoiseIsTheSameWhateverTheMusclesDo) {
  Protocol strong = quiet(kHold);
  set_truth(strong, {"emg_noise=true"});
  Protocol weak = strong;
  weak.trials[0].peak = 0.3;
  const VirtualRecording a = make_virtual_recording(strong, 7);
  const VirtualRecording b = make_virtual_recording(weak, 7);
  for (std::size_t m : {kBiceps, kTriceps}) {
    EXPECT_EQ(channel(a, m), channel(b, m));
    EXPECT_GT(rms(channel(a, m)), 0.2);
  }
  EXPECT_GT(a.trials[0].truth.activation.column("BIC").maxCoeff(),
            2.0 * b.trials[0].truth.activation.column("BIC").maxCoeff());
}

}  // namespace
}  // namespace myoid::lab
