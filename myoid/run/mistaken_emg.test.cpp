#include "myoid/run/mistaken_emg.h"

#include <gtest/gtest.h>

#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/fit/methods/cross_validation.h"
#include "myoid/fit/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::run {
namespace {

using fit::EstimatorOptions;
using fit::IdentificationResult;
using fit::of_a_fold;
using fit::StudyData;
using fit::TrialData;

test::ElbowStudy person(std::uint64_t seed) {
  test::ElbowStudyOptions options = test::noisy_person(seed);
  options.seconds = 15.0;
  return test::elbow_study(options);
}

void exchange(StudyData& data, std::size_t a, std::size_t b) {
  std::swap(data.muscles[a].emg_channel, data.muscles[b].emg_channel);
}

/// Looks for an exchange where no muscle lies far from what is known of people and the fit has this R2.
std::optional<MistakenEmg> found_at(const test::ElbowStudy& study, std::optional<double> r2 = {}) {
  const EstimatorOptions options = of_a_fold({});
  IdentificationResult fit = fit::identify_torque(study.data, options);
  fit.prior_distances.clear();
  fit.r2 = r2.value_or(fit.r2);
  return mistaken_emg(study.data, options, fit);
}

/// Looks for an exchange after a fit of the study with the names that it has.
std::optional<MistakenEmg> found_in(const test::ElbowStudy& study) {
  const EstimatorOptions options = of_a_fold({});
  return mistaken_emg(study.data, options, fit::identify_torque(study.data, options));
}

TEST(MistakenEmg, IsNoneWhereChannelsAreNamedRight) {
  // With seeds 1 to 60 the fit suspects none, either.
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto found = found_in(person(seed));
    EXPECT_FALSE(found) << seed << ": " << found->sentence();
  }
}

TEST(MistakenEmg, OfTwoSidesAndOfOneSideIsFoundByTheFit) {
  // With seeds 1 to 40 the fit finds biceps and triceps in 39 persons, and biceps and brachioradialis in 37.
  int opposed = 0, synergists = 0;
  constexpr int kPersons = 4;
  for (std::uint64_t seed = 1; seed <= kPersons; ++seed) {
    for (const std::size_t other : {3, 2}) {
      test::ElbowStudy study = person(seed);
      exchange(study.data, 0, other);
      const auto found = found_in(study);
      if (!found) continue;
      // The channels still bear the names of the muscles that they should be on.
      const std::string name = study.data.muscles[0].emg_channel;
      const bool right =
          (found->first == name && found->second == "BIC") || (found->first == "BIC" && found->second == name);
      (other == 3 ? opposed : synergists) += right ? 1 : 0;
    }
  }
  EXPECT_EQ(opposed, kPersons);
  EXPECT_GE(synergists, 3 * kPersons / 4);
}

TEST(MistakenEmg, IsSoughtWhereTheFitLeavesMuchUnexplained) {
  test::ElbowStudy study = person(1);
  exchange(study.data, 0, 3);
  EXPECT_TRUE(found_at(study, 0.8));
  EXPECT_FALSE(found_at(study, 0.95));
}

TEST(MistakenEmg, IsNoneWhateverTheFitExplains) {
  // With seeds 1 to 18 none, either, although every pair is tried.
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto found = found_at(person(seed), 0.0);
    EXPECT_FALSE(found) << seed << ": " << found->sentence();
  }
}

/// Puts `values` in the place of the EMG of the second of four trials.
template <typename Change>
test::ElbowStudy with_second_trial(std::uint64_t seed, const Change& change) {
  test::ElbowStudyOptions options = test::noisy_person(seed);
  options.seconds = 15.0;
  options.trials = 4;
  test::ElbowStudy study = test::elbow_study(options);
  TrialData& trial = study.data.trials[1];
  Eigen::MatrixXd values = trial.activation.values();
  change(values);
  trial.activation = TimeSeries(trial.activation.time_s(), trial.activation.channels(), values);
  return study;
}

TEST(MistakenEmg, OfOneTrialIsNamedWithItsTrial) {
  // With seeds 1 to 6 biceps and triceps, and biceps and brachioradialis, are found in all.
  for (const int other : {3, 2}) {
    const test::ElbowStudy study = with_second_trial(1, [&](Eigen::MatrixXd& emg) { emg.col(0).swap(emg.col(other)); });
    const auto found = found_in(study);
    ASSERT_TRUE(found) << other;
    EXPECT_EQ(found->trial, "trial2");
    EXPECT_EQ(found->first, "BIC");
    EXPECT_EQ(found->second, study.data.muscles[static_cast<std::size_t>(other)].name);
  }
}

TEST(MistakenEmg, OfOneTrialsGainIsNamedWithTheFactor) {
  // With seeds 1 to 6 the factor is found within a fifth.
  for (const double gain : {3.0, 1.0 / 3.0}) {
    const auto found = found_in(with_second_trial(1, [&](Eigen::MatrixXd& emg) { emg *= gain; }));
    ASSERT_TRUE(found) << gain;
    EXPECT_EQ(found->trial, "trial2");
    EXPECT_FALSE(found->is_exchange());
    EXPECT_NEAR(found->gain / gain, 1.0, 0.25);
  }
}

TEST(MistakenEmg, OfOneTrialsClockIsNamedWithItsLag) {
  for (const double late_s : {0.6, -0.4}) {
    test::ElbowStudy study = with_second_trial(1, [](const auto&) {});
    test::delay_emg(study.data.trials[1], late_s);
    const auto found = found_in(study);
    ASSERT_TRUE(found) << late_s;
    EXPECT_EQ(found->trial, "trial2");
    EXPECT_TRUE(found->is_clock()) << found->sentence();
    EXPECT_NEAR(found->late_s, late_s, 0.1);
  }
}

TEST(MistakenEmg, OfOneTrialIsNoneWhereAllTrialsAreAlike) {
  // With seeds 1 to 18 none, either.
  for (std::uint64_t seed = 1; seed <= 4; ++seed) EXPECT_FALSE(found_in(with_second_trial(seed, [](const auto&) {})));
}

TEST(MistakenEmg, OfExchangedChannelsCountsByTheirOwnMusclesLevels) {
  // The triceps' level is a third of the biceps': exchanged, its channel holds the biceps' volts over a third.
  const test::ElbowStudy study = with_second_trial(1, [](Eigen::MatrixXd& emg) {
    emg.col(0).swap(emg.col(3));
    emg.col(0) /= 3.0;
    emg.col(3) *= 3.0;
  });
  EstimatorOptions options = of_a_fold({});
  const IdentificationResult fit = fit::identify_torque(study.data, options);
  const auto by_numbers = mistaken_emg(study.data, options, fit);
  options.channels = {{.channel = "BIC", .full_v = 3e-4}, {.channel = "TRI", .full_v = 1e-4}};
  const auto by_volts = mistaken_emg(study.data, options, fit);
  ASSERT_TRUE(by_volts);
  EXPECT_EQ(by_volts->first, "BIC");
  EXPECT_EQ(by_volts->second, "TRI");
  EXPECT_GT(by_volts->log_odds, (by_numbers ? by_numbers->log_odds : 0.0) + kMistakenOdds);
}

TEST(MistakenEmg, OfAGainSpoilsAllNumbersWhereItIsSure) {
  MistakenEmg mistaken{.trial = "slow", .gain = 3.0, .log_odds = 2.0 * kSureOdds, .r2 = 0.9};
  EXPECT_TRUE(mistaken.spoils_all(0.5));
  mistaken.log_odds = 0.5 * kSureOdds;
  EXPECT_FALSE(mistaken.spoils_all(0.5));
  const MistakenEmg exchanged{.first = "BIC", .second = "TRI", .log_odds = 2.0 * kSureOdds, .r2 = 0.9};
  EXPECT_FALSE(exchanged.spoils_all(0.5));
  EXPECT_TRUE(exchanged.spoils_all(0.95));
}

// With seeds 1 to 8, ln odds of opposed muscles are 41 to 54, and of synergists 8 to 14, which a pull that nobody sees
// explains as well.
TEST(MistakenEmg, BesideAMuscleWithoutEmgNeedsMoreOdds) {
  const auto found_beside = [](std::size_t other) {
    test::ElbowStudy study = person(3);
    study.data.muscles[1].unseen = fit::UnseenActivation{.by = fit::WithoutEmg::unseen, .parts = {}};
    study.data.muscles[1].emg_channel = "without EMG";
    fit::expect_activations(study.data);
    exchange(study.data, 0, other);
    return found_in(study);
  };
  const auto opposed = found_beside(3);
  ASSERT_TRUE(opposed);
  EXPECT_GT(opposed->log_odds, kSureOdds);
  EXPECT_FALSE(found_beside(2));
}

TEST(MistakenEmg, OneMuscleHasNobodyToExchangeWith) {
  test::ElbowStudy study = person(1);
  for (auto& setup : study.data.muscles) setup.emg_channel = "BIC";
  EXPECT_FALSE(found_in(study));
}

}  // namespace
}  // namespace myoid::run
