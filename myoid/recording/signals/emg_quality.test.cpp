#include "myoid/recording/signals/emg_quality.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/random.h"

namespace myoid::recording {
namespace {

constexpr double kEmgRate_hz = 2000.0;
constexpr Eigen::Index kSamples = 24000;

/// Band-limited noise (difference of a moving average's ends) that rests and works in turn, up to
/// 200 uV rms over 3 uV of noise, quantized to 0.3 uV like a 16-bit recording.
Eigen::VectorXd muscle(std::uint64_t seed) {
  math::Random random(seed);
  Eigen::VectorXd x(kSamples);
  double slow = 0.0;
  for (Eigen::Index i = 0; i < kSamples; ++i) {
    const double t = static_cast<double>(i) / kEmgRate_hz;
    const double effort = std::max(0.0, std::sin(1.3 * t + static_cast<double>(seed)));
    const double white = random.normal();
    const double emg = white - slow;
    slow += 0.1 * (white - slow);
    x[i] = std::round((2e-4 * effort * emg + 3e-6 * random.normal()) / 3e-7) * 3e-7;
  }
  return x;
}

TimeSeries recording(const std::vector<Eigen::VectorXd>& columns) {
  Eigen::MatrixXd values(kSamples, static_cast<Eigen::Index>(columns.size()));
  std::vector<Channel> channels;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    values.col(static_cast<Eigen::Index>(c)) = columns[c];
    channels.push_back({std::string(1, static_cast<char>('a' + c)), Unit::volt});
  }
  return {Eigen::VectorXd::LinSpaced(kSamples, 0.0, (kSamples - 1) / kEmgRate_hz), channels, values};
}

Eigen::ArrayXd seconds() { return Eigen::ArrayXd::LinSpaced(kSamples, 0.0, (kSamples - 1) / kEmgRate_hz); }

/// Returns the kinds of fault found in one channel.
std::set<RemarkCode> kinds(const Eigen::VectorXd& x) {
  std::set<RemarkCode> result;
  for (const Remark& fault : check_emg(recording({x}))) result.insert(fault.code);
  return result;
}

using Kinds = std::set<RemarkCode>;

TEST(EmgQuality, WhatNoElectrodeGivesIsNamedWithItsSize) {
  EXPECT_TRUE(kinds(muscle(3)).empty());
  EXPECT_TRUE(kinds(1e4 * muscle(3)).empty());  // an amplifier's output, some 8 V
  const std::vector<Remark> faults = check_emg(recording({4e5 * muscle(3)}));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::emg_amplitude);
  EXPECT_GT(*faults[0].value, 100.0);
  Eigen::VectorXd spike = muscle(3);
  spike[7000] = 1e30;
  EXPECT_EQ(kinds(spike), Kinds{RemarkCode::emg_artifact});
  spike.segment(7000, 20).setConstant(1e30);  // too long for a spike
  EXPECT_TRUE(kinds(spike).contains(RemarkCode::emg_amplitude));
}

TEST(EmgQuality, ChannelsInAnotherUnitThanVoltsAreOneRemark) {
  const std::vector<Remark> faults = check_emg(recording({4e5 * muscle(3), 3e5 * muscle(4), 1e-1 * muscle(5)}));
  const auto count = std::ranges::count(faults, RemarkCode::emg_amplitude, &Remark::code);
  ASSERT_EQ(count, 1);
  EXPECT_EQ(std::ranges::count(faults.front().about, ','), 1) << faults.front().about;
}

TEST(EmgQuality, AnEnvelopeIsToldFromRawEmgWhateverItsOffset) {
  Eigen::VectorXd envelope = 1e-4 * (1.0 - (1.3 * seconds()).cos());
  EXPECT_EQ(kinds(envelope), Kinds{RemarkCode::emg_envelope});
  envelope[100] = -2e-6;  // a filter's swing
  EXPECT_EQ(kinds(envelope), Kinds{RemarkCode::emg_envelope});
  // From a converter without negative numbers.
  EXPECT_FALSE(kinds(muscle(3).array() + 2.5).contains(RemarkCode::emg_envelope));
  // A large drift of the baseline keeps raw EMG from crossing its median for a long time.
  EXPECT_FALSE(kinds(muscle(3).array() + 1e-3 * (0.3 * seconds()).sin()).contains(RemarkCode::emg_envelope));
}

TEST(EmgQuality, RectifiedEmgIsToldFromRawEmg) {
  for (const Eigen::VectorXd& x : {Eigen::VectorXd(muscle(3).cwiseAbs()), Eigen::VectorXd(1e3 * muscle(4).cwiseAbs())})
    EXPECT_EQ(kinds(x), Kinds{RemarkCode::emg_envelope});
  // Raw EMG on an offset is never negative, but it keeps far from zero.
  EXPECT_TRUE(kinds(muscle(3).array() - muscle(3).minCoeff() + 1e-6).empty());
}

TEST(EmgQuality, OfHumItIsSaidWhetherANotchTakesItOut) {
  const Eigen::VectorXd x = muscle(1) + (1e-4 * (2.0 * kPi * 50.0 * seconds()).sin()).matrix();
  EXPECT_NE(check_emg(recording({x}))[0].remedy.find("notches"), std::string::npos);
  EXPECT_NE(check_emg(recording({x}), {.notched = false})[0].remedy.find("no notch"), std::string::npos);
}

TEST(EmgQuality, OfCleanRecordingsNothingIsSaid) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    EXPECT_TRUE(check_emg(recording({muscle(3 * seed), muscle(3 * seed + 1), muscle(3 * seed + 2)})).empty());
}

TEST(EmgQuality, ADeadChannelIsFlatAndALostTransmissionForItsTime) {
  EXPECT_EQ(kinds(Eigen::VectorXd::Constant(kSamples, 1e-3)), Kinds{RemarkCode::emg_flat});
  Eigen::VectorXd x = muscle(1);
  x.segment(4000, 1000).setConstant(x[4000]);
  const auto faults = check_emg(recording({x}));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::emg_flat);
  EXPECT_NEAR(faults[0].when->begin_s, 2.0, 1e-9);
  EXPECT_NEAR(faults[0].when->end_s, 2.4995, 1e-9);
}

TEST(EmgQuality, FlatTopsAreClippingAndALongOneIsSaturation) {
  Eigen::VectorXd x = muscle(1);
  x = x.cwiseMin(2.5e-4).cwiseMax(-2.5e-4);
  EXPECT_EQ(kinds(x), Kinds{RemarkCode::emg_clipped});
  x = muscle(1);
  x.segment(9000, 100).setConstant(1.1 * x.maxCoeff());
  EXPECT_EQ(kinds(x), Kinds{RemarkCode::emg_saturated});
}

TEST(EmgQuality, HumIsHeard) {
  const Eigen::VectorXd x = muscle(1) + (1e-4 * (2.0 * kPi * 50.0 * seconds()).sin()).matrix();
  EXPECT_EQ(kinds(x), Kinds{RemarkCode::emg_hum});
}

TEST(EmgQuality, AWanderingBaselineMattersWithoutAHighPassOnly) {
  const Eigen::VectorXd x = muscle(1) + (1e-3 * (0.6 * seconds()).sin()).matrix();
  const auto removed = check_emg(recording({x}));
  ASSERT_EQ(removed.size(), 1U);
  EXPECT_EQ(removed[0].code, RemarkCode::emg_drift);
  EXPECT_EQ(removed[0].severity, Severity::note);
  EXPECT_EQ(check_emg(recording({x}), {.high_passed = false})[0].severity, Severity::warning);
}

TEST(EmgQuality, OutsideAStudyARemedyNamesNoKeyOfIt) {
  Eigen::VectorXd lost = muscle(1);
  lost.segment(4000, 1000).setConstant(lost[4000]);
  for (const Eigen::VectorXd& x :
       {Eigen::VectorXd(Eigen::VectorXd::Constant(kSamples, 1e-3)), lost, Eigen::VectorXd(muscle(3).cwiseAbs()),
        Eigen::VectorXd(1e-4 * (1.0 - (1.3 * seconds()).cos())),
        Eigen::VectorXd(muscle(1) + (1e-3 * (0.6 * seconds()).sin()).matrix())}) {
    const auto faults = check_emg(recording({x}), {.high_passed = false, .remedies = EmgRemedies::options_of_emg});
    ASSERT_FALSE(faults.empty());
    for (const char* key : {"[emg]", "same_as", "start_s", "highpass_hz"})
      EXPECT_EQ(faults[0].remedy.find(key), std::string::npos) << faults[0].remedy;
  }
}

TEST(EmgQuality, AMovementOfTheCableIsAnArtifactAtItsTime) {
  Eigen::VectorXd x = muscle(1);
  for (Eigen::Index i = 0; i < 500; ++i) x[10000 + i] += 3e-3 * std::sin(2.0 * kPi * static_cast<double>(i) / 250.0);
  const auto faults = check_emg(recording({x}));
  ASSERT_EQ(faults.size(), 1U) << sentence(faults[0]);
  EXPECT_EQ(faults[0].code, RemarkCode::emg_artifact);
  EXPECT_NEAR(faults[0].when->begin_s, 5.0, 0.26);
}

TEST(EmgQuality, WhatTwoChannelsHaveInCommonIsCrosstalk) {
  const Eigen::VectorXd a = muscle(1);
  const Eigen::VectorXd b = muscle(2);
  // Half of a's amplitude in b, 3 ms later: rho = 0.5 / sqrt(1.25) = 0.45 where both are as loud.
  Eigen::VectorXd mixed = 0.3 * b;
  mixed.tail(kSamples - 6) += 0.5 * a.head(kSamples - 6);
  const auto faults = check_emg(recording({a, mixed}));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::emg_crosstalk);
  EXPECT_EQ(faults[0].about, "a, b");
  const auto same = check_emg(recording({a, a}));
  ASSERT_EQ(same.size(), 1U);
  EXPECT_NE(same[0].says.find("same"), std::string::npos);
}

TEST(EmgQuality, OfAChannelOfNothingButNoiseNeitherWanderNorArtifactIsTold) {
  math::Random random(7);
  Eigen::VectorXd x(kSamples);
  for (Eigen::Index i = 0; i < kSamples; ++i) x[i] = 2e-6 * random.normal();
  const Eigen::VectorXd wander = (3e-5 * (0.9 * seconds()).sin() + 1e-5 * (30.0 * seconds()).sin()).matrix();
  EXPECT_TRUE(kinds(x + wander).empty());
  // The check tells both of a working muscle.
  EXPECT_EQ(kinds(muscle(3) + 300.0 * wander), (Kinds{RemarkCode::emg_drift, RemarkCode::emg_artifact}));
}

TEST(EmgQuality, AnEnvelopeOnItsGreatestValueIsNotSaturatedAndOutsideAStudyANote) {
  Eigen::VectorXd x(1000);
  for (Eigen::Index i = 0; i < 1000; ++i) x[i] = 2e-6 * (1.2 - std::cos(0.02 * static_cast<double>(i)));
  x.segment(155, 5).setConstant(4.4e-6);
  const TimeSeries envelope(Eigen::VectorXd::LinSpaced(1000, 0.0, 9.99), {{"a", Unit::volt}}, x);
  for (const bool study : {true, false}) {
    const std::vector<Remark> faults =
        check_emg(envelope, {.remedies = study ? EmgRemedies::keys_of_study : EmgRemedies::none});
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].code, RemarkCode::emg_envelope);
    EXPECT_EQ(faults[0].severity, study ? Severity::warning : Severity::note);
    EXPECT_EQ(faults[0].remedy.find("[emg] kind") != std::string::npos, study) << faults[0].remedy;
  }
}

}  // namespace
}  // namespace myoid::recording
