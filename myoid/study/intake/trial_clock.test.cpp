#include "myoid/study/intake/trial_clock.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/study/intake/read_trial.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/read_study.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

using ::testing::HasSubstr;

/// A trial whose EMG system has a clock of its own: of the truth (1 + drift) t + offset at its t. Both systems record a
/// pulse every 5 s or so; the motion is a swing of the elbow, and the EMG an envelope that leads it by 60 ms.
class TwoClocks : public ::testing::Test {
 protected:
  static constexpr double kOffset_s = 0.2345;
  static constexpr double kDrift_ppm = 50.0;

  TwoClocks() {
    std::string motion =
        "Coordinates\nversion=1\nnRows=6001\nnColumns=3\ninDegrees=no\nendheader\n"
        "time\telbow_flexion\tsync\n";
    for (int i = 0; i <= 6000; ++i) {
      const double t = 0.01 * i;
      motion += fmt::format("{:.4f}\t{:.8f}\t{}\n", t, swing(t), pulse(t) ? 1 : 0);
    }
    write_file(folder / "m.mot", motion);
    std::string emg = "time,b,Trig\n";
    for (int i = 0; i <= 14750; ++i) {
      const double t = 0.004 * i;
      const double truth = t + 1e-6 * kDrift_ppm * t + kOffset_s;
      emg += fmt::format("{:.4f},{:.8f},{}\n", t, 0.5 + 0.2 * swing(truth + 0.06), pulse(truth) ? 5 : 0);
    }
    write_file(folder / "e.csv", emg);
  }

  static double swing(double t) {
    return 1.2 + 0.4 * std::sin(2.0 * kPi * 0.6 * t) + 0.3 * std::sin(2.0 * kPi * 0.37 * t + 1.0);
  }
  static bool pulse(double t) {
    for (const double s :
         {1.3137, 6.1082, 12.0044, 16.9161, 22.4093, 27.0018, 33.3175, 38.0029, 44.7126, 49.1070, 55.5101}) {
      if (t >= s && t < s + 0.05) return true;
    }
    return false;
  }

  [[nodiscard]] Study study(const std::string& sync, const std::string& trial = "") const {
    return parse_study((sync.empty() ? "" : "[sync]\n" + sync) +
                           "[emg]\nkind = \"envelope\"\n[[muscle]]\nname = \"BIC\"\nemg = \"b\"\n"
                           "[[trial]]\nname = \"t\"\nmotion = \"m.mot\"\nemg = \"e.csv\"\n" +
                           trial,
                       folder / "study.toml");
  }
  [[nodiscard]] TrialInput read(const Study& s) const { return read_trial_input(s, s.trials[0], arm); }
  std::string refusal(const std::string& sync, const std::string& trial = "") const {
    return test::message_of([&] { (void)read(study(sync, trial)); });
  }

  test::TemporaryFolder folder;
  body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
};

TEST_F(TwoClocks, ByPulsesThatBothRecordedOffsetAndDriftAreFoundWithinTheirErrors) {
  const TrialInput input = read(study("emg_trigger = \"Trig\"\nmotion_trigger = \"sync\"\n"));
  ASSERT_TRUE(input.emg_clock);
  const recording::ClockMap& clock = input.emg_clock->clock;
  // Edges of the motion are known to 10 ms / sqrt(12), those of the EMG to 4 ms / sqrt(12), 11 of them, over 54 s.
  EXPECT_NEAR(*clock.offset_sd_s, 0.0031 / std::sqrt(11.0), 1e-4);
  for (const double t : {0.0, 30.0, 59.0}) {
    const double truth = t + 1e-6 * kDrift_ppm * t + kOffset_s;
    EXPECT_NEAR(clock.study_time_s(t), truth, 0.003) << t;
  }
  EXPECT_NEAR(clock.drift_ppm, kDrift_ppm, 3.0 * *clock.drift_sd_ppm);
  EXPECT_LT(*clock.drift_sd_ppm, 60.0);
  ASSERT_FALSE(input.remarks.empty());
  EXPECT_THAT(input.remarks[0].says, HasSubstr("11 instants of 'Trig' and 'sync'"));
  // Samples are moved, not changed, and the 60 ms between EMG and motion stay.
  EXPECT_NEAR(input.emg->time_s()[0], kOffset_s, 0.003);
  EXPECT_NEAR(input.emg->values()(5000, 0), 0.5 + 0.2 * swing(input.emg->time_s()[5000] + 0.06), 0.003);
}

TEST_F(TwoClocks, ByNumbersTheTimesAreWhatTheStudySays) {
  const TrialInput input = read(study("offset_s = 0.2345\ndrift_ppm = 50\noffset_sd_s = 0.002\n"));
  EXPECT_NEAR(input.emg->time_s()[12500], 50.0 + 50e-6 * 50.0 + 0.2345, 1e-9);
  EXPECT_THAT(input.remarks[0].says, HasSubstr("+234.5 ± 2 ms, 50 ppm"));
}

TEST_F(TwoClocks, EstimatedFromEmgAndMotionTheOffsetIsFoundWithinItsError) {
  const TrialInput input = read(study("offset_s = \"estimate\"\ndrift_ppm = 50\n"));
  ASSERT_TRUE(input.emg_clock);
  EXPECT_NEAR(input.emg_clock->clock.offset_s, kOffset_s, 2.0 * *input.emg_clock->clock.offset_sd_s);
  EXPECT_GE(*input.emg_clock->clock.offset_sd_s, kUsualLeadSd_s);
  EXPECT_THAT(input.remarks[0].says, HasSubstr("estimated"));
}

TEST_F(TwoClocks, ATrialsOwnSyncWinsOverTheStudys) {
  const TrialInput input = read(study("offset_s = 5.0\n", "sync = { offset_s = 0.25, loads_offset_s = 0.5 }\n"));
  EXPECT_NEAR(input.emg->time_s()[0], 0.25, 1e-12);
}

TEST_F(TwoClocks, StartAndEndAreTimesOfTheMotion) {
  const TrialInput input = read(study("offset_s = 3.0\n", "start_s = 10.0\nend_s = 20.0\n"));
  EXPECT_NEAR(input.emg->time_s()[0], 9.5, 1e-9);  // half a second more for the delay
  EXPECT_NEAR(input.emg->time_s()[input.emg->sample_count() - 1], 20.0, 1e-9);
  EXPECT_NEAR(input.emg->values()(0, 0), 0.5 + 0.2 * swing(6.5 * (1 + 50e-6) + 0.2345 + 0.06), 1e-6);
}

TEST_F(TwoClocks, WithoutSyncNothingMoves) {
  const TrialInput input = read(study(""));
  EXPECT_FALSE(input.emg_clock);
  EXPECT_EQ(input.emg->time_s()[0], 0.0);
}

TEST_F(TwoClocks, AnEmgOfTheMotionsOwnFileStaysOnItsClock) {
  Study s = study("offset_s = 3.0\n");
  s.trials[0].emg = s.trials[0].motion;
  EXPECT_FALSE(trial_clock(
      s, s.trials[0], {}, [] { return TimeSeries(); }, [](const auto&) {}));
  EXPECT_THAT(refusal("", "emg_ = 1\n"), HasSubstr("emg_"));
  EXPECT_THROW((void)parse_study("[[muscle]]\nname = \"BIC\"\nemg = \"b\"\n[[trial]]\nname = \"t\"\n"
                                 "markers = \"a.c3d\"\nemg = \"a.c3d\"\nsync = { offset_s = 1 }\n",
                                 folder / "study.toml"),
               ReadError);
}

TEST_F(TwoClocks, WhatIsWrongWithATriggerIsSaidWithWhatThereIs) {
  EXPECT_THAT(refusal("emg_trigger = \"Trigg\"\nmotion_trigger = \"sync\"\n"), HasSubstr("'Trig'"));
  EXPECT_THAT(refusal("emg_trigger = \"Trig\"\n"), HasSubstr("give both"));
  EXPECT_THAT(refusal("emg_trigger = \"Trig\"\nmotion_trigger = \"sync\"\noffset_s = 1\n"), HasSubstr("offset_s"));
  EXPECT_THAT(refusal("emg_trigger = \"Trig\"\nmotion_trigger = \"start\"\n"), HasSubstr("too few"));
  EXPECT_THAT(refusal("emg_trigger = \"b\"\nmotion_trigger = \"sync\"\n"), HasSubstr("[sync]"));
}

TEST_F(TwoClocks, ASignalThatBothRecordedMatchesByItsShape) {
  // "b" is the swing 60 ms early: the shape says so, and that is what was asked for.
  const TrialInput input = read(study("emg_trigger = \"b\"\nmotion_trigger = \"elbow_flexion\"\nmatch = \"shape\"\n"));
  EXPECT_NEAR(input.emg_clock->clock.study_time_s(30.0), 30.0 + 0.0015 + 0.2345 + 0.06,
              4.0 * *input.emg_clock->clock.offset_sd_s);
  EXPECT_LT(*input.emg_clock->clock.offset_sd_s, 2e-3);
}

}  // namespace
}  // namespace myoid::study
