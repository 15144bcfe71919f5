#include "myoid/study/phases/find_phases.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"

namespace myoid::study {
namespace {

constexpr double kRate_hz = 100.0;

/// What happens between two times.
struct Scene {
  double end_s = 0.0;
  double amplitude_rad = 0.8;  ///< Of a movement at 1 Hz; 0: stands still.
  double activation = 0.2;
  double gain = 1.0;        ///< Measured torque per predicted.
  double gain_slope = 0.0;  ///< Its change per second.
  double frequency_hz = 80.0;
  double frequency_slope = 0.0;
};

/// A recording by its script: torque noise of 4 % within a movement, 3 % of frequency per window.
PhaseSignals recording(const std::vector<Scene>& scenes, bool raw_emg = true, std::uint64_t seed = 1) {
  math::Random random(seed, 0);
  const auto n = static_cast<Eigen::Index>(scenes.back().end_s * kRate_hz) + 1;
  PhaseSignals s;
  s.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, scenes.back().end_s);
  s.velocity_radps = s.torque_nm = s.predicted_nm = Eigen::VectorXd::Zero(n);
  s.activation = Eigen::MatrixXd::Zero(n, 2);
  Eigen::VectorXd frequency(n);
  std::size_t k = 0;
  double cycle_noise = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = s.time_s[i];
    while (t > scenes[k].end_s + 1e-9) ++k;
    const Scene& scene = scenes[k];
    const double since = t - (k == 0 ? 0.0 : scenes[k - 1].end_s);
    if (i % 100 == 0) cycle_noise = 0.04 * random.normal();
    const double phase = 2.0 * std::numbers::pi * t;
    s.velocity_radps[i] = 2.0 * std::numbers::pi * scene.amplitude_rad * std::cos(phase);
    s.predicted_nm[i] = scene.amplitude_rad > 0.0 ? 10.0 + 5.0 * std::sin(phase) : 12.0 * scene.activation;
    s.torque_nm[i] = s.predicted_nm[i] * (scene.gain + scene.gain_slope * since + cycle_noise);
    s.activation.row(i).setConstant(scene.activation);
    frequency[i] = scene.frequency_hz + scene.frequency_slope * since;
  }
  if (raw_emg) {
    const Eigen::Index windows = n / 200;
    Eigen::VectorXd middle(windows);
    Eigen::MatrixXd f(windows, 2);
    for (Eigen::Index w = 0; w < windows; ++w) {
      middle[w] = s.time_s[w * 200 + 100];
      for (Eigen::Index c = 0; c < 2; ++c) f(w, c) = frequency[w * 200 + 100] * (1.0 + 0.03 * random.normal());
    }
    s.median_frequency_hz = {middle, {{"a", Unit::hertz}, {"b", Unit::hertz}}, f};
  }
  return s;
}

std::vector<PhaseKind> kinds(const std::vector<Phase>& phases) {
  std::vector<PhaseKind> result;
  for (const Phase& phase : phases) result.push_back(phase.kind);
  return result;
}

TEST(FindPhases, OfARegularTrialThereIsOne) {
  int single = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto phases = find_phases(recording({{.end_s = 60.0}}, true, seed));
    EXPECT_DOUBLE_EQ(phases.front().begin_s, 0.0);
    EXPECT_DOUBLE_EQ(phases.back().end_s, 60.0);
    single += phases.size() == 1 && phases.front().kind == PhaseKind::regular ? 1 : 0;
  }
  EXPECT_EQ(single, 40);
}

TEST(FindPhases, FindsTheFatigueOfThePapersSequences) {
  // Isometric contraction, warm-up, the regular movement, and muscles that tire (its figures 8-10).
  const auto phases = find_phases(
      recording({{.end_s = 6.0, .amplitude_rad = 0.0},
                 {.end_s = 18.0, .gain = 1.3},
                 {.end_s = 60.0},
                 {.end_s = 90.0, .gain = 0.9, .gain_slope = -0.01, .frequency_hz = 74.0, .frequency_slope = -0.8}}));
  ASSERT_EQ(kinds(phases), (std::vector{PhaseKind::isometric, PhaseKind::regular, PhaseKind::fatigued}));
  // A stop is seen half a second late or early (the window of the rate), and fatigue that begins gently some blocks.
  EXPECT_NEAR(phases[1].begin_s, 6.0, 0.6);
  EXPECT_NEAR(phases[2].begin_s, 60.0, 6.1);
  EXPECT_LT(*phases[2].gain, 0.85);
  EXPECT_LT(*phases[2].frequency, 0.88);
  for (std::size_t i = 1; i < phases.size(); ++i) EXPECT_DOUBLE_EQ(phases[i].begin_s, phases[i - 1].end_s);
}

TEST(FindPhases, LessTorqueAtTheSameFrequencyIsNotCalledFatigue) {
  const std::vector<Scene> script{{.end_s = 40.0}, {.end_s = 60.0, .gain = 0.8}};
  EXPECT_EQ(kinds(find_phases(recording(script))), std::vector{PhaseKind::regular});
  // Without raw EMG the torque alone speaks.
  const auto phases = find_phases(recording(script, false));
  ASSERT_EQ(kinds(phases), (std::vector{PhaseKind::regular, PhaseKind::fatigued}));
  EXPECT_FALSE(phases[1].frequency);
}

TEST(FindPhases, AnotherMovementOrAnotherBeginningIsNoFatigue) {
  EXPECT_EQ(kinds(find_phases(recording({{.end_s = 16.0, .amplitude_rad = 0.3, .gain = 1.3}, {.end_s = 60.0}}))),
            std::vector{PhaseKind::regular});
  EXPECT_EQ(kinds(find_phases(recording({{.end_s = 4.75, .gain = 1.5}, {.end_s = 40.0}}))),
            std::vector{PhaseKind::regular});
}

TEST(FindPhases, MusclesThatTireFromTheBeginningAreFatiguedWhereATenthIsLost) {
  // Torque per EMG falls by 0.3 % each second: ln(1 - 0.003 t), which bends, has lost a tenth after 33 s; the straight
  // trend through it some 10 to 18 s later.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto phases =
        find_phases(recording({{.end_s = 150.0, .gain_slope = -0.003, .frequency_slope = -0.25}}, true, seed));
    ASSERT_EQ(kinds(phases), (std::vector{PhaseKind::regular, PhaseKind::fatigued})) << seed;
    EXPECT_GT(phases[1].begin_s, 30.0) << seed;
    EXPECT_LT(phases[1].begin_s, 52.0) << seed;
  }
}

TEST(FindPhases, AHeldContractionTires) {
  const auto phases =
      find_phases(recording({{.end_s = 60.0, .amplitude_rad = 0.0, .gain_slope = -0.006, .frequency_slope = -0.4}}));
  ASSERT_EQ(kinds(phases), (std::vector{PhaseKind::isometric, PhaseKind::fatigued}));
  EXPECT_NEAR(phases[1].begin_s, 20.0, 10.0);
  EXPECT_DOUBLE_EQ(phases[1].end_s, 60.0);
  EXPECT_EQ(kinds(find_phases(recording({{.end_s = 60.0, .amplitude_rad = 0.0}}))), std::vector{PhaseKind::isometric});
}

TEST(FindPhases, RestIsStandingStillWithoutActivation) {
  const auto phases = find_phases(
      recording({{.end_s = 20.0}, {.end_s = 25.0, .amplitude_rad = 0.0, .activation = 0.01}, {.end_s = 45.0}}));
  ASSERT_EQ(kinds(phases), (std::vector{PhaseKind::regular, PhaseKind::rest, PhaseKind::regular}));
  EXPECT_NEAR(phases[1].begin_s, 20.0, 0.6);
  EXPECT_NEAR(phases[1].end_s, 25.0, 0.6);
}

TEST(FindPhases, AShortTrialIsRegular) {
  const auto phases = find_phases(recording({{.end_s = 8.0}}));
  ASSERT_EQ(phases.size(), 1u);
  EXPECT_NE(phases[0].reason.find("too short"), std::string::npos);
  PhaseSignals wrong = recording({{.end_s = 8.0}});
  wrong.torque_nm[3] = std::nan("");
  EXPECT_THROW(static_cast<void>(find_phases(wrong)), InvalidInput);
}

}  // namespace
}  // namespace myoid::study
