#include "myoid/recording/signals/emg_levels.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::recording {
namespace {

TimeSeries envelope(const std::vector<double>& levels) {
  const auto n = static_cast<Eigen::Index>(levels.size()) * 200;
  Eigen::MatrixXd x(n, 1);
  for (Eigen::Index i = 0; i < n; ++i) x(i, 0) = levels[static_cast<std::size_t>(i / 200)];
  return {Eigen::VectorXd::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1)), {{"BIC", Unit::volt}}, x};
}

TEST(EmgLevels, AMuscleThatRestsAndWorksIsNotComplainedOf) {
  const TimeSeries movement = envelope({1e-6, 5e-5});
  const TimeSeries mvc = envelope({1e-6, 1e-4});
  const std::vector<TrialEnvelope> trials{{"move", false, &movement}, {"mvc", true, &mvc}};
  EXPECT_TRUE(check_emg_levels(trials).empty());
}

TEST(EmgLevels, AChannelThatHardlyRisesIsNamed) {
  const TimeSeries movement = envelope({1e-5, 3e-5});
  const std::vector<TrialEnvelope> trials{{"move", false, &movement}};
  const auto faults = check_emg_levels(trials);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::emg_low_signal);
  EXPECT_NEAR(*faults[0].value, 3.0, 1e-9);
}

/// The spectrum of noise (0.97) and of EMG (0.4).
TrialEnvelope with_flatness(TrialEnvelope trial, double flatness) {
  trial.flatness = Eigen::VectorXd::Constant(1, flatness);
  return trial;
}

TEST(EmgLevels, AChannelOfNothingButNoiseIsAnErrorAndAHeldEffortIsNot) {
  const TimeSeries noise = envelope({2e-6, 2.2e-6, 1.9e-6});
  const TimeSeries loud = envelope({2e-5, 2.2e-5, 1.9e-5});
  EXPECT_EQ(check_emg_levels(std::vector{with_flatness({"a", false, &loud}, 0.97)})[0].severity, Severity::warning);
  for (const double flatness : {0.97, 0.4, 0.0}) {
    const std::vector<TrialEnvelope> trials{with_flatness({"a", false, &noise}, flatness)};
    const auto faults = check_emg_levels(trials);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].severity, flatness > 0.9 ? Severity::error : Severity::warning);
  }
}

TEST(EmgLevels, AnElectrodeThatIsLostInOneTrialIsNamedAndAMuscleAtRestIsNot) {
  const TimeSeries works = envelope({1e-5, 1e-4});
  const TimeSeries rests = envelope({1.05e-5, 1.1e-5});
  const TimeSeries silent = envelope({2e-6, 2.1e-6});
  const TimeSeries loud = envelope({4e-5, 4.2e-5});
  const auto faults_with = [&](const TimeSeries& one, double flatness, int others) {
    std::vector<TrialEnvelope> trials{with_flatness({"one", false, &one}, flatness)};
    for (int i = 0; i < others; ++i) trials.push_back(with_flatness({"other", false, &works}, 0.4));
    return check_emg_levels(trials);
  };
  EXPECT_TRUE(faults_with(rests, 0.97, 3).empty());
  EXPECT_TRUE(faults_with(loud, 0.4, 3).empty());     // an effort held throughout
  EXPECT_TRUE(faults_with(silent, 0.97, 2).empty());  // two trials do not tell rest
  for (const TimeSeries* lost : {&silent, &loud}) {
    const auto faults = faults_with(*lost, 0.97, 3);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].code, RemarkCode::emg_low_signal);
    EXPECT_EQ(faults[0].severity, Severity::warning);
    EXPECT_NE(faults[0].says.find("'BIC' in one"), std::string::npos) << faults[0].says;
  }
}

TEST(EmgLevels, OfOneRecordingNoTrialsAreSpokenOfAndAMuscleThatWorksThroughoutIsANote) {
  const TimeSeries held = envelope({7e-5, 1.8e-4, 9e-5});
  const auto faults = check_emg_levels(std::vector{with_flatness({"a", false, &held}, 0.43)});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].severity, Severity::note);
  EXPECT_EQ(faults[0].about, "BIC");
  EXPECT_NE(faults[0].says.find(" 70 uV"), std::string::npos) << faults[0].says;
  const TimeSeries weak = envelope({4e-6, 8e-6});
  const auto low = check_emg_levels(std::vector{with_flatness({"a", false, &weak}, 0.43)});
  EXPECT_EQ(low.at(0).code, RemarkCode::emg_low_signal);
  EXPECT_NE(low[0].says.find(" 2 times"), std::string::npos) << low[0].says;
}

/// Biceps and triceps.
TimeSeries two(const TimeSeries& biceps, const TimeSeries& triceps) {
  Eigen::MatrixXd both(biceps.sample_count(), 2);
  both << biceps.values(), triceps.values();
  return {biceps.time_s(), {{"BIC", Unit::volt}, {"TRI", Unit::volt}}, both};
}

TEST(EmgLevels, WhiteNoiseInOneTrialWhileAllOthersShowAWorkingMuscleIsNamed) {
  const TimeSeries works = envelope({2e-6, 3e-5}), dead = envelope({2e-6, 2.2e-6});
  const TimeSeries other = two(works, works), lost = two(dead, works), relaxed = two(dead, dead);
  const auto faults_with = [&](const TimeSeries& one, double flatness, const TimeSeries& last) {
    std::vector<TrialEnvelope> trials;
    for (const TimeSeries* trial : {&one, &other, &other, &last})
      trials.push_back({trial == &one ? "one" : "other", false, trial, {}, Eigen::Vector2d(flatness, 0.4)});
    return check_emg_levels(trials);
  };
  const auto faults = faults_with(lost, 0.97, other);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].severity, Severity::warning);
  EXPECT_EQ(faults[0].code, RemarkCode::emg_low_signal);
  EXPECT_NE(faults[0].says.find("'BIC' in one"), std::string::npos) << faults[0].says;
  EXPECT_NE(faults[0].says.find(" 2.2 uV"), std::string::npos) << faults[0].says;
  EXPECT_TRUE(faults_with(lost, 0.4, other).empty());      // a spectrum of EMG
  EXPECT_TRUE(faults_with(relaxed, 0.97, other).empty());  // everybody rests
  EXPECT_TRUE(faults_with(lost, 0.97, lost).empty());      // the muscle rests in another trial, too
}

TEST(EmgLevels, AnotherGainIsToldOfATrialOrOfAChannelAndNoEffortIsTakenForIt) {
  const TimeSeries move = envelope({2e-6, 3e-5, 2e-6}), strong = envelope({2e-6, 3e-4, 2e-6});
  const TimeSeries held = envelope({2e-5, 3e-5, 2e-5});
  const auto times = [](const TimeSeries& x, double gain) {
    return TimeSeries(x.time_s(), x.channels(), gain * x.values());
  };
  const TimeSeries plain = two(move, times(move, 2.0));
  const auto gains = [&](const TimeSeries& one, const std::vector<TimeSeries>& others) {
    std::vector<TrialEnvelope> trials{{"one", false, &one}};
    for (const TimeSeries& other : others) trials.push_back({"other", false, &other});
    std::vector<Remark> faults = check_emg_levels(trials);
    std::erase_if(faults, [](const Remark& f) { return f.code != RemarkCode::emg_gain; });
    return faults;
  };
  const std::vector<TimeSeries> three(3, plain);
  for (const double gain : {0.1, 4.0}) {
    const auto faults = gains(times(plain, gain), three);
    ASSERT_EQ(faults.size(), 1U) << gain;
    EXPECT_EQ(faults[0].about, "one");
    EXPECT_NEAR(*faults[0].value, gain, 1e-9);
  }
  const auto one_channel = gains(two(times(move, 10.0), times(move, 2.0)), three);
  ASSERT_EQ(one_channel.size(), 1U);
  EXPECT_EQ(one_channel[0].about, "BIC");
  EXPECT_TRUE(gains(two(times(move, 4.0), times(move, 2.0)), three).empty());  // a tense muscle
  EXPECT_TRUE(gains(times(plain, 2.0), three).empty());                        // trials differ
  EXPECT_TRUE(gains(two(strong, strong), three).empty());                      // rest is rest
  EXPECT_TRUE(gains(times(plain, 10.0), {plain, plain}).empty());              // two trials do not tell
  EXPECT_TRUE(gains(two(times(held, 5.0), times(held, 5.0)), std::vector(3, two(held, held))).empty());
}

/// Bursts of 0.3 s in a cycle of 1.1 s: the second of lowest mean always holds most of one.
TEST(EmgLevels, TwoStepsOfWalkingAreNotComplainedOf) {
  const Eigen::Index n = 240;
  Eigen::MatrixXd x(n, 1);
  for (Eigen::Index i = 0; i < n; ++i)
    x(i, 0) =
        1e-6 + 4e-5 * std::exp(-0.5 * std::pow((std::fmod(0.01 * static_cast<double>(i), 1.1) - 0.5) / 0.12, 2.0));
  const TimeSeries walk(Eigen::VectorXd::LinSpaced(n, 0.0, 2.39), {{"GAS", Unit::volt}}, x);
  const std::vector<TrialEnvelope> trials{{"walk", false, &walk}};
  EXPECT_TRUE(check_emg_levels(trials).empty());
}

TEST(EmgLevels, AMovementAboveTheMaximalContractionIsNamedWithTrialAndTime) {
  const TimeSeries movement = envelope({1e-6, 1.3e-4, 1e-6});
  const TimeSeries mvc = envelope({1e-6, 1e-4});
  const std::vector<TrialEnvelope> trials{{"move", false, &movement}, {"mvc", true, &mvc}};
  const auto faults = check_emg_levels(trials);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::emg_over_reference);
  EXPECT_NEAR(*faults[0].value, 1.3, 1e-9);
  EXPECT_NE(faults[0].says.find("(mvc) in move"), std::string::npos) << faults[0].says;
}

TEST(EmgLevels, ATrialInAnotherUnitIsAnErrorAndAContractionThatWasNoneIsNot) {
  const auto twice = [](const TimeSeries& biceps, double triceps) {
    return two(biceps, TimeSeries(biceps.time_s(), biceps.channels(), triceps * biceps.values()));
  };
  const TimeSeries mvc = twice(envelope({1e-6, 1e-4}), 1.0);
  const TimeSeries plain = twice(envelope({1e-6, 5e-5, 1e-6}), 1.0);
  const TimeSeries thousandfold = twice(envelope({1e-3, 4.5e-2, 1e-3}), 2.0);
  const std::vector<TrialEnvelope> trials{
      {"move", false, &plain}, {"swing", false, &thousandfold}, {"mvc", true, &mvc}};
  const auto faults = check_emg_levels(trials);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].severity, Severity::error);
  for (const char* part : {"'swing'", "450 to 900 times", "another unit", "mV for V"})
    EXPECT_NE(faults[0].says.find(part), std::string::npos) << faults[0].says;
  // The rest is the same, or another channel is: nobody contracted this muscle fully.
  const TimeSeries strong = twice(envelope({1e-6, 4.5e-2, 1e-6}), 1.0);
  const TimeSeries one = twice(envelope({1e-3, 4.5e-2, 1e-3}), 1e-3);
  for (const TimeSeries* movement : {&strong, &one}) {
    const std::vector<TrialEnvelope> pair{{"swing", false, movement}, {"mvc", true, &mvc}};
    for (const Remark& fault : check_emg_levels(pair)) EXPECT_EQ(fault.severity, Severity::warning) << fault.says;
    EXPECT_FALSE(check_emg_levels(pair).empty());
  }
}

TEST(EmgLevels, ASpikeIsShortAndPercentAreNot) {
  Eigen::VectorXd a = Eigen::VectorXd::Constant(1000, 0.4);
  a[500] = 50.0;
  EXPECT_EQ(time_above_s(a, 100.0, 2.0), 0.01);
  EXPECT_EQ(time_above_s(100.0 * a, 100.0, 2.0), 10.0);
  EXPECT_EQ(time_above_s(a, 100.0, 60.0), 0.0);
  EXPECT_EQ(time_above_s(Eigen::VectorXd(), 100.0, 0.0), 0.0);
}

}  // namespace
}  // namespace myoid::recording
