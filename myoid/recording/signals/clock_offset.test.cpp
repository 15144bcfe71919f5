#include "myoid/recording/signals/clock_offset.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/random.h"

namespace myoid::recording {
namespace {

/// An irregular swing: angle and the torque that it needs, I q'' + m g l sin q, in closed form.
struct Swing {
  std::uint64_t seed = 1;
  [[nodiscard]] double angle(double t) const { return sum(t, 0); }
  [[nodiscard]] double torque(double t) const { return 0.06 * sum(t, 2) + 2.0 * std::sin(angle(t)); }

 private:
  [[nodiscard]] double sum(double t, int derivative) const {
    math::Random random(seed);
    double value = derivative == 0 ? 1.0 : 0.0;
    for (int k = 0; k < 6; ++k) {
      const double w = 2.0 * kPi * (0.4 + 1.0 * random.uniform());
      const double phase = 2.0 * kPi * random.uniform();
      const double amplitude = 0.6 / (1.0 + 0.3 * w);
      value += derivative == 0 ? amplitude * std::sin(w * t + phase) : -amplitude * w * w * std::sin(w * t + phase);
    }
    return value;
  }
};

TimeSeries motion(const Swing& swing, double length_s, double shift_s = 0.0) {
  const auto n = static_cast<Eigen::Index>(100.0 * length_s);
  Eigen::MatrixXd q(n, 1);
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  for (Eigen::Index i = 0; i < n; ++i) q(i, 0) = swing.angle(t[i] - shift_s);
  return {t, {{"elbow_flexion", Unit::radian}}, q};
}

/// Flexor and extensor that provide the torque `lead_s` later, with 15 % of noise in the envelope.
TimeSeries effort(const Swing& swing, double length_s, double lead_s, double stretch = 1.0) {
  const auto n = static_cast<Eigen::Index>(100.0 * length_s);
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  math::Random random(swing.seed + 100);
  Eigen::MatrixXd a(n, 2);
  Eigen::Vector2d noise = Eigen::Vector2d::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double torque = swing.torque(stretch * t[i] + lead_s);
    noise = 0.7 * noise + 0.7 * Eigen::Vector2d(random.normal(), random.normal());
    a(i, 0) = std::max(0.02, torque / 4.0) * (1.0 + 0.15 * noise[0]);
    a(i, 1) = std::max(0.02, -torque / 4.0 + 0.1) * (1.0 + 0.15 * noise[1]);
  }
  return {t, {{"BIC", Unit::volt}, {"TRI", Unit::volt}}, a};
}

TEST(ClockOffset, IsFoundWithinItsUncertainty) {
  int missed = 0, silent = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Swing swing{seed};
    for (const double lead_s : {-0.2, 0.06, 0.35}) {
      const auto offset = estimate_clock_offset(effort(swing, 20.0, lead_s), motion(swing, 20.0));
      if (!offset) {
        ++silent;
        continue;
      }
      EXPECT_NEAR(offset->lead_s, lead_s, 0.05) << seed;
      missed += std::abs(offset->lead_s - lead_s) > 2.0 * offset->scatter_s + 0.01 ? 1 : 0;
      // 0.4 to 1.4 Hz.
      EXPECT_GT(offset->phase_s, 0.25 / 1.4);
      EXPECT_LT(offset->phase_s, 0.25 / 0.4);
    }
  }
  // Two standard deviations hold 95 % of 30; the fitted model (a linear mixture) only approximates the truth.
  EXPECT_LE(missed, 5);
  EXPECT_LE(silent, 3);
}

TEST(ClockOffset, OfWhatHasNothingToDoWithTheMotionNothingIsSaid) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    found += estimate_clock_offset(effort({seed}, 20.0, 0.0), motion({seed + 50}, 20.0)) ? 1 : 0;
  EXPECT_LE(found, 2);
  const Swing swing{1};
  EXPECT_FALSE(estimate_clock_offset(effort(swing, 2.0, 0.05), motion(swing, 2.0)));
  TimeSeries still = motion(swing, 20.0);
  still = TimeSeries(still.time_s(), still.channels(), 0.0 * still.values());
  EXPECT_FALSE(estimate_clock_offset(effort(swing, 20.0, 0.05), still));
}

TEST(ClockOffset, OfASlowOrATinyMovementNothingIsSaid) {
  // Ten times slower, the torque follows the posture at any delay; without movement it is noise.
  const Swing swing{1};
  const TimeSeries quick = motion(swing, 20.0);
  const TimeSeries slow(10.0 * quick.time_s(), quick.channels(), quick.values());
  const TimeSeries drive = effort(swing, 20.0, 0.05);
  EXPECT_FALSE(estimate_clock_offset(TimeSeries(10.0 * drive.time_s(), drive.channels(), drive.values()), slow));
  const TimeSeries tiny(quick.time_s(), quick.channels(), 0.01 * quick.values());
  EXPECT_FALSE(estimate_clock_offset(drive, tiny));
}

TEST(ClockOffset, OutsideWhatABodyCanDoItIsAWarning) {
  const Swing swing{2};
  // Within the usual range and uncertain by a quarter of a second, an offset says nothing.
  EXPECT_TRUE(check_clock_offset(effort(swing, 20.0, 0.08), motion(swing, 20.0)).empty());
  const auto late = check_clock_offset(effort(swing, 20.0, -0.55), motion(swing, 20.0));
  ASSERT_EQ(late.size(), 1U);
  EXPECT_EQ(late[0].severity, Severity::warning);
  EXPECT_NE(late[0].says.find("behind"), std::string::npos);
}

/// Steps of 1.1 s: two joints move, a calf muscle works at the end of stance, a shin muscle in swing, each step a
/// little more or less strongly.
TEST(ClockOffset, OfGaitWhichRepeatsItselfNothingIsSaid) {
  const Eigen::Index n = 2000;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    math::Random random(seed);
    std::vector<double> strength;
    for (int k = 0; k < 30; ++k) strength.push_back(1.0 + 0.05 * random.normal());
    Eigen::MatrixXd q(n, 2), a(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double step = t[i] / 1.1, phase = 2.0 * kPi * step, within = step - std::floor(step);
      const double size = strength[static_cast<std::size_t>(step)];
      q(i, 0) = size * (0.15 * std::sin(phase) + 0.15 * std::sin(2.0 * phase + 1.0) + 0.05 * std::sin(3.0 * phase));
      q(i, 1) = size * (0.4 * std::sin(phase + 2.0) + 0.2 * std::sin(2.0 * phase + 0.5));
      a(i, 0) = size * std::exp(-0.5 * std::pow((within - 0.45) / 0.08, 2.0)) + 0.02 * (1.0 + 0.2 * random.normal());
      a(i, 1) = size * std::exp(-0.5 * std::pow((within - 0.75) / 0.12, 2.0)) + 0.02 * (1.0 + 0.2 * random.normal());
    }
    for (const double late_s : {0.0, 0.2, 0.4, 0.6, 0.8}) {
      const TimeSeries emg(Eigen::VectorXd(t.array() + late_s), {{"GAS", Unit::volt}, {"TA", Unit::volt}}, a);
      EXPECT_TRUE(check_clock_offset(emg, {t, {{"ankle", Unit::radian}, {"knee", Unit::radian}}, q}).empty())
          << seed << " " << late_s;
    }
  }
}

TEST(ClockOffset, AClockThatRunsFastIsADrift) {
  const Swing swing{3};
  bool drift = false;
  // 0.4 % over 60 s: from the first third to the last 0.16 s.
  for (const Remark& fault : check_clock_offset(effort(swing, 60.0, 0.0, 1.004), motion(swing, 60.0))) {
    if (fault.code != RemarkCode::clock_drift) continue;
    drift = true;
    EXPECT_NEAR(*fault.value, 0.16, 0.06);
  }
  EXPECT_TRUE(drift);
  for (const Remark& fault : check_clock_offset(effort(swing, 60.0, 0.05), motion(swing, 60.0)))
    EXPECT_NE(fault.code, RemarkCode::clock_drift);
}

TEST(ClockEvenness, OnlyVaryingIntervalsAreTold) {
  Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(100, 0.0, 0.99);
  EXPECT_FALSE(check_clock_evenness(t, "m.mot"));
  for (Eigen::Index i = 0; i < 100; i += 2) t[i] += 0.002;
  const auto fault = check_clock_evenness(t, "m.mot");
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->severity, Severity::note);
}

}  // namespace
}  // namespace myoid::recording
