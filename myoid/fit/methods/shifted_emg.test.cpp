#include "myoid/fit/methods/shifted_emg.h"

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

constexpr UsualLead kUsual{.earliest_s = -0.1, .latest_s = 0.3};

StudyData four_trials(std::uint64_t seed) {
  test::ElbowStudyOptions options = test::noisy_person(seed);
  options.trials = 4;
  options.seconds = 15.0;
  return test::elbow_study(options).data;
}

TEST(ShiftedEmg, IsNotSuspectedWhereTheClocksAgree) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto found = shifted_emg(four_trials(seed), kUsual);
    EXPECT_FALSE(found) << seed << ": " << found->sentence();
  }
}

TEST(ShiftedEmg, OfAllTrialsOrOfOneIsFoundToATenthOfASecond) {
  int all = 0, one = 0;
  constexpr int kPersons = 10;
  for (std::uint64_t seed = 1; seed <= kPersons; ++seed) {
    for (const double late_s : {0.6, -0.5}) {
      StudyData data = four_trials(seed);
      for (TrialData& trial : data.trials) test::delay_emg(trial, late_s);
      const auto found = shifted_emg(data, kUsual);
      all += found && found->trial.empty() && std::abs(found->lead_s + late_s - 0.05) < 0.11 ? 1 : 0;
      StudyData single = four_trials(seed);
      test::delay_emg(single.trials[1], late_s);
      const auto alone = shifted_emg(single, kUsual);
      one += alone && alone->trial == single.trials[1].name && std::abs(alone->lead_s + late_s - 0.05) < 0.11 ? 1 : 0;
    }
  }
  EXPECT_GE(all, kPersons);
  EXPECT_GE(one, kPersons);
  RecordProperty("all", all);
  RecordProperty("one", one);
}

}  // namespace
}  // namespace myoid::fit
