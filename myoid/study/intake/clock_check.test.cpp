#include "myoid/study/intake/clock_check.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

TEST(ClockOfATrial, AShortPauseOfTheClockIsWarnedOfAndALongOneRefused) {
  const Study study = arm_study();
  EXPECT_TRUE(sentences(WrittenTrial(0.01, 5.0).read(study).remarks, Severity::warning).empty());
  std::vector<Remark> paused = WrittenTrial(0.01, 5.3, 0.3).read(study).remarks;
  std::erase_if(paused, [](const Remark& r) { return r.severity != Severity::warning; });
  ASSERT_EQ(paused.size(), 1U);
  EXPECT_EQ(paused[0].code, RemarkCode::clock_pause);
  EXPECT_NE(paused[0].says.find("2.49 to 2.8 s"), std::string::npos) << paused[0].says;
  const std::string message = message_of([&] { (void)WrittenTrial(0.01, 8.0, 3.0).read(study); });
  EXPECT_NE(message.find("2.49 to 5.5 s"), std::string::npos) << message;
}

TEST(ClockOfATrial, AClockInMillisecondsIsRefused) {
  const std::string message = message_of([&] { (void)WrittenTrial(10.0, 5.0).read(arm_study()); });
  EXPECT_NE(message.find("in ms"), std::string::npos) << message;
}

TEST(ClockOfATrial, ACutOffAboveWhatTheRateAllowsIsRefused) {
  Study study = arm_study();
  study.motion.smoothing = Smoothing::cutoff;
  study.motion.cutoff_hz = 60.0;
  const std::string message = message_of([&] { (void)WrittenTrial(0.01, 5.0).read(study); });
  EXPECT_NE(message.find("cutoff_hz = 60"), std::string::npos) << message;
}

TEST(CheckClock, AnEvenClockIsNotSpokenOfAndAPauseCarriesTheStretchesAboutIt) {
  Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(1001, 0.0, 10.0);
  EXPECT_EQ(check_clock("m.mot", time_s), "");
  time_s.tail(500).array() += 2.0;
  try {
    (void)check_clock("m.mot", time_s);
    FAIL() << "a pause of 2 s passed";
  } catch (const ClockPause& pause) {
    ASSERT_EQ(pause.stretches().size(), 2U);
    EXPECT_NEAR(pause.stretches()[0].end_s, 5.0, 1e-9);
    EXPECT_NEAR(pause.stretches()[1].begin_s, 7.01, 1e-9);
  }
}

}  // namespace
}  // namespace myoid::study
