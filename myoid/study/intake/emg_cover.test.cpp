#include "myoid/study/intake/emg_cover.h"

#include <gtest/gtest.h>

#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

TrialLengths lengths(double emg_s, double motion_s) { return {"t", emg_s, motion_s, 100.0, 1000.0}; }

TEST(LengthsOf, AreOfRecordingsThatShouldLastAlike) {
  const TrialInput input = WrittenTrial(0.01, 4.99).read(arm_study());
  TrialSpec trial;
  trial.motion = "m.mot";
  trial.emg = "e.sto";
  const std::vector<TrialLengths> found = lengths_of(trial, input);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].emg_s, 4.99, 1e-9);
  EXPECT_NEAR(found[0].motion_rate_hz, 100.0, 1e-6);
  trial.use = Use::mvc;
  EXPECT_TRUE(lengths_of(trial, input).empty());
  trial.use = Use::static_pose;
  EXPECT_TRUE(lengths_of(trial, input).empty());
  trial.use = Use::calibration;
  EXPECT_NEAR(found[0].emg_rate_hz, 100.0, 1e-6);
  trial.end_s = 10.0;
  EXPECT_TRUE(lengths_of(trial, input).empty());
  trial.end_s.reset();
  trial.emg = trial.motion;  // one file: one clock
  EXPECT_TRUE(lengths_of(trial, input).empty());
}

TEST(LengthsOf, AreNotOfClocksThatWereMatchedNorOfARecordingThatBeganLater) {
  TrialInput input = WrittenTrial(0.01, 4.99).read(arm_study());
  TrialSpec trial;
  trial.motion = "m.mot";
  trial.emg = "e.sto";
  const TimeSeries emg = *input.emg;
  input.emg = TimeSeries(emg.time_s().array() + 0.6, emg.channels(), emg.values());
  EXPECT_TRUE(lengths_of(trial, input).empty());
  input.emg = TimeSeries(emg.time_s().array() + 0.4, emg.channels(), emg.values());
  EXPECT_EQ(lengths_of(trial, input).size(), 1U);
  input.emg_clock.emplace();
  EXPECT_TRUE(lengths_of(trial, input).empty());
  input.external_torque = TimeSeries(2.0 * emg.time_s(), emg.channels(), emg.values());
  EXPECT_TRUE(is_rate_wrong(lengths_of(trial, input)));
}

TEST(CheckCover, WantsHalfASecondAndHalfOfTheMotion) {
  TrialSpec trial;
  const auto check = [&](double motion_to_s, double emg_from_s, double emg_to_s) {
    TrialInput input;
    input.motion = TimeSeries(Eigen::VectorXd::LinSpaced(50, 0.0, motion_to_s), {{"elbow_flexion", Unit::radian}},
                              Eigen::MatrixXd::Zero(50, 1));
    return check_cover("e.sto", "EMG", Eigen::VectorXd::LinSpaced(50, emg_from_s, emg_to_s), trial, input);
  };
  EXPECT_NE(message_of([&] { check(0.4, 0.0, 0.4); }).find("0.5 s"), std::string::npos);
  EXPECT_FALSE(check(0.6, 0.0, 0.6));
  EXPECT_NE(message_of([&] { check(10.0, 0.0, 4.0); }).find("half"), std::string::npos);
  EXPECT_NE(message_of([&] { check(10.0, 6.0, 12.0); }).find("half"), std::string::npos);
  const std::optional<Cover> cover = check(10.0, 1.0, 7.0);
  ASSERT_TRUE(cover);
  EXPECT_EQ(cover->begin_s, 1.0);
  EXPECT_EQ(cover->end_s, 7.0);
  EXPECT_NE(cover->lacks.find("lacks 4 s"), std::string::npos) << cover->lacks;
  EXPECT_EQ(cover->lacks.find("e.sto:"), 0U) << cover->lacks;
  EXPECT_FALSE(cover->as_long);
  EXPECT_TRUE(check(10.0, 0.3, 10.3)->as_long);
  EXPECT_FALSE(check(10.0, 0.05, 10.0));
  // Only the trial's part of the motion counts.
  trial.start_s = 1.0;
  trial.end_s = 3.0;
  EXPECT_FALSE(check(10.0, 0.5, 3.0));
  EXPECT_EQ(check(10.0, 0.5, 2.5)->end_s, 2.5);
}

TEST(UnlikeLengths, EmgExactlyTwiceAsLongIsAnErrorThatNamesBothRates) {
  const std::vector<Remark> found = unlike_lengths({lengths(51.28, 25.64), lengths(20.0, 20.1)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  for (const char* rate : {" 2000 Hz", " 50 Hz"})
    EXPECT_NE(found[0].says.find(rate), std::string::npos) << found[0].says;
}

TEST(UnlikeLengths, EmgOfHalfTheMotionIsAnError) {
  // 1 % from a half: motion that is longer than its EMG was not stopped late.
  EXPECT_EQ(unlike_lengths({lengths(25.8, 51.1)}).at(0).severity, Severity::error);
  const std::vector<Remark> found = unlike_lengths({lengths(25.6, 51.1)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_NE(found[0].says.find("199.6 Hz"), std::string::npos) << found[0].says;
}

TEST(UnlikeLengths, AnAmplifierThatRunsOnIsNoFault) {
  EXPECT_TRUE(unlike_lengths({lengths(30.0, 20.0), lengths(26.0, 10.0)}).empty());
  EXPECT_TRUE(unlike_lengths({lengths(20.3, 20.0), lengths(10.2, 10.0)}).empty());
  EXPECT_TRUE(unlike_lengths({lengths(12.0, 10.0)}).empty());
  EXPECT_TRUE(unlike_lengths({}).empty());
  EXPECT_EQ(unlike_lengths({lengths(17.0, 10.0)}).size(), 1U);
  // About twice as long asks.
  const std::vector<Remark> found = unlike_lengths({lengths(20.2, 10.0)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
}

TEST(UnlikeLengths, OneFactorInEveryTrialNamesTheRate) {
  for (const double factor : {1.2, 0.8}) {
    const std::vector<Remark> found = unlike_lengths({lengths(factor * 20.0, 20.0), lengths(factor * 12.0, 12.0)});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].where, "study");
    EXPECT_EQ(found[0].severity, Severity::warning);
  }
  EXPECT_TRUE(unlike_lengths({lengths(24.0, 20.0), lengths(12.0, 12.0)}).empty());
}

TEST(UnlikeLengths, OneRatioInTrialsOfUnlikeLengthIsAClockThatRunsFast) {
  // Stated at 1926 Hz and recorded at 2000 Hz.
  const double ratio = 2000.0 / 1926.0;
  const std::vector<Remark> found =
      unlike_lengths({lengths(6.0 * ratio, 6.0), lengths(8.0 * ratio, 8.0), lengths(12.0 * ratio, 12.0)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, RemarkCode::emg_length);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_NEAR(found[0].value.value(), ratio, 1e-9);
  // An amplifier that runs on for 0.3 s is longer by a time, and trials of one length tell no ratio.
  EXPECT_TRUE(unlike_lengths({lengths(6.3, 6.0), lengths(8.3, 8.0), lengths(12.3, 12.0)}).empty());
  EXPECT_TRUE(unlike_lengths({lengths(8.3, 8.0), lengths(8.3, 8.0), lengths(8.3, 8.0)}).empty());
  EXPECT_TRUE(unlike_lengths({lengths(6.001, 6.0), lengths(8.0, 8.0), lengths(12.002, 12.0)}).empty());
}

TEST(UnlikeLengths, EmgOfTwoTrialsThatFitsTheOthersMotionIsCalledExchanged) {
  const std::vector<Remark> found =
      unlike_lengths({lengths(26.6, 25.6), lengths(25.64, 26.62), lengths(24.0, 24.02), lengths(28.0, 28.0)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].says.find("each EMG is as long as the other trial's motion"), std::string::npos) << found[0].says;
  // Recordings stopped by hand.
  EXPECT_TRUE(unlike_lengths({lengths(26.6, 25.6), lengths(25.64, 26.62), lengths(24.0, 24.3)}).empty());
  EXPECT_TRUE(unlike_lengths({lengths(26.6, 25.6), lengths(25.3, 24.6)}).empty());
}

TEST(RowsWithEmg, AreThoseThatTheEmgCovers) {
  const Eigen::VectorXd motion = Eigen::VectorXd::LinSpaced(101, 0.0, 10.0);
  const Rows all = rows_with_emg(motion, Eigen::VectorXd::LinSpaced(100, 0.04, 9.96));
  EXPECT_EQ(all.count(), 101);
  const Rows some = rows_with_emg(motion, Eigen::VectorXd::LinSpaced(100, 2.0, 7.5));
  EXPECT_EQ(some.first, 20);
  EXPECT_EQ(some.last, 75);
  EXPECT_LE(rows_with_emg(motion, Eigen::VectorXd::LinSpaced(9, 20.0, 30.0)).count(), 0);
}

TEST(UnlikeLengths, LoadsTwiceAsLongAreAWarningUnlessTheEmgSaysSo) {
  TrialLengths loads = lengths(4.777, 2.37);
  loads.of_loads = true;
  const std::vector<Remark> found = unlike_lengths({lengths(2.38, 2.37), loads});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_EQ(found[0].says.find("the loads"), 0U) << found[0].says;
  EXPECT_NE(found[0].says.find("4.777 s"), std::string::npos) << found[0].says;
  EXPECT_TRUE(is_rate_wrong({loads}));
  loads.emg_s = 3.9;  // of no whole factor: recorded for longer
  EXPECT_TRUE(unlike_lengths({lengths(2.38, 2.37), loads}).empty());
  EXPECT_FALSE(is_rate_wrong({lengths(2.38, 2.37), loads}));
  const TrialLengths emg = lengths(2.39, 4.74);
  loads = {.trial = "t", .emg_s = 2.39, .motion_s = 4.74, .of_loads = true};
  ASSERT_EQ(unlike_lengths({emg, loads}).size(), 1U);
  EXPECT_EQ(unlike_lengths({emg, loads})[0].about, "EMG and motion");
  EXPECT_TRUE(is_rate_wrong({emg, loads}));
}

}  // namespace
}  // namespace myoid::study
