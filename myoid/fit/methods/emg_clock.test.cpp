#include "myoid/fit/methods/emg_clock.h"

#include <utility>

#include <gtest/gtest.h>

#include "myoid/fit/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

TEST(FitOfLabels, IsThatOfTheMusclesThemselvesWhereTheyAreTheTruth) {
  test::ElbowStudy study = test::elbow_study({.seconds = 15.0});
  for (std::size_t k = 0; k < 4; ++k) study.data.muscles[k].start = study.truth[k];
  EXPECT_GT(fit_of_labels(study.data, study.delay_s).r2, 0.9999);
  // With all forces twice as large one gain makes up for it.
  for (auto& setup : study.data.muscles) setup.start.max_isometric_force_n *= 2.0;
  EXPECT_GT(fit_of_labels(study.data, study.delay_s).r2, 0.9999);
  std::swap(study.data.muscles[0].emg_channel, study.data.muscles[3].emg_channel);
  EXPECT_LT(fit_of_labels(study.data, study.delay_s).r2, 0.5);
}

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

TEST(ShiftedEmg, OfAllTrialsIsFoundToATenthOfASecond) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const double late_s : {0.6, -0.5}) {
      StudyData data = four_trials(seed);
      for (TrialData& trial : data.trials) test::delay_emg(trial, late_s);
      const auto found = shifted_emg(data, kUsual);
      ASSERT_TRUE(found) << seed;
      EXPECT_NEAR(found->lead_s + late_s, 0.05, 0.11) << seed;
      // The clock of one trial does not move the error of all.
      StudyData single = four_trials(seed);
      test::delay_emg(single.trials[1], late_s);
      EXPECT_FALSE(shifted_emg(single, kUsual)) << seed;
    }
  }
}

/// A noisy recording whose EMG is stamped `late_s` after its own time; its muscles pull with the EMG.
StudyData recording(double late_s, std::uint64_t seed, std::size_t late_trials = 3) {
  test::ElbowStudyOptions options = test::noisy_person(seed);
  options.delay_s = 0.0;
  StudyData data = test::elbow_study(options).data;
  for (std::size_t i = 0; i < late_trials; ++i) test::delay_emg(data.trials[i], late_s);
  return data;
}

const ParameterEstimate& delay_of(const IdentificationResult& fit) {
  return *std::ranges::find(fit.estimates, std::string("emg_delay"), &ParameterEstimate::parameter);
}

TEST(LateEmg, OfAllTrialsOrOfOneIsNoAbsentDelay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const IdentificationResult all = identify_torque(recording(0.1, seed));
    const ParameterEstimate& delay = delay_of(all);
    EXPECT_EQ(delay.verdict, Verdict::not_identifiable) << seed << ": " << delay.estimate << ' ' << delay.reason;
    EXPECT_NE(delay.reason.find("late clock"), std::string::npos) << delay.reason;
    ASSERT_FALSE(all.warnings.empty());
    EXPECT_EQ(all.warnings.back().code, RemarkCode::late_emg);
    EXPECT_EQ(all.warnings.back().says, "emg_delay: " + delay.reason);
    const StudyData data = recording(0.3, seed, 1);
    const auto one = late_emg(data, identify_torque(data), 0.0);
    ASSERT_TRUE(one) << seed;
    EXPECT_EQ(one->trial, data.trials[0].name);
    EXPECT_NEAR(one->late_s, 0.3, 0.15);
  }
}

TEST(LateEmg, IsNoneWhereMusclesPullWithTheirEmg) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const StudyData data = recording(0.004, seed);  // within the error allowed to a delay
    const IdentificationResult fit = identify_torque(data);
    const ParameterEstimate& delay = delay_of(fit);
    EXPECT_EQ(delay.reason.find("late clock"), std::string::npos) << seed << ": " << delay.reason;
  }
}

}  // namespace
}  // namespace myoid::fit
