#include "myoid/fit/methods/exchanged_electrodes.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using fit::StudyData;

StudyData person(std::uint64_t seed) {
  test::ElbowStudyOptions options = test::noisy_person(seed);
  options.seconds = 15.0;
  return test::elbow_study(options).data;
}

void exchange(StudyData& data, std::size_t a, std::size_t b) {
  std::swap(data.muscles[a].emg_channel, data.muscles[b].emg_channel);
}

TEST(ExchangedElectrodes, AreNoneWhereTheyAreNamedRight) {
  // Of seeds 1 to 150 with twice the noise none was suspected wrongly, either.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto found = exchanged_electrodes(person(seed), 0.06);
    EXPECT_FALSE(found) << seed << ": " << found->sentence();
  }
}

TEST(ExchangedElectrodes, OfTwoSidesAreFoundAndOfOneSideWhereTheirSignalsDiffer) {
  // With twice the noise it finds, of seeds 1 to 150, biceps and triceps in 125 persons, and biceps
  // and brachioradialis in 37.
  int opposed = 0;
  int synergists = 0;
  constexpr int kPersons = 20;
  for (std::uint64_t seed = 1; seed <= kPersons; ++seed) {
    for (const std::size_t other : {3, 2}) {
      StudyData data = person(seed);
      exchange(data, 0, other);
      const auto found = exchanged_electrodes(data, 0.06);
      if (!found) continue;
      // The channels still bear the names of the muscles that they should be on.
      const std::string name = data.muscles[0].emg_channel;
      const bool right =
          (found->first == name && found->second == "BIC") || (found->first == "BIC" && found->second == name);
      (other == 3 ? opposed : synergists) += right ? 1 : 0;
    }
  }
  EXPECT_GE(opposed, 3 * kPersons / 4);
  EXPECT_GE(synergists, kPersons / 5);
}

TEST(ExchangedElectrodes, AreNotComparedWhereOneTrialAloneSetsTheReference) {
  int suspected = 0, with_a_gain = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    StudyData data = person(seed);
    exchange(data, 0, 3);
    suspected += exchanged_electrodes(data, 0.06) ? 1 : 0;
    TrialData& strongest = *std::ranges::max_element(
        data.trials, {}, [](const TrialData& t) { return t.activation.column("BIC").maxCoeff(); });
    const TimeSeries a = strongest.activation;
    Eigen::MatrixXd values = a.values();
    values.col(a.index("BIC")) *= 3.0;
    strongest.activation = TimeSeries(a.time_s(), a.channels(), values);
    const auto found = exchanged_electrodes(data, 0.06);
    with_a_gain += found && (found->first == "BIC" || found->second == "BIC") ? 1 : 0;
  }
  EXPECT_GE(suspected, 15);
  EXPECT_EQ(with_a_gain, 0);
}

TEST(FitOfLabels, IsThatOfTheMusclesThemselvesWhereTheyAreTheTruth) {
  test::ElbowStudy study = test::elbow_study({.seconds = 15.0});
  for (std::size_t k = 0; k < 4; ++k) study.data.muscles[k].start = study.truth[k];
  EXPECT_GT(fit_of_labels(study.data, study.delay_s).r2, 0.9999);
  // With all forces twice as large one gain makes up for it.
  for (auto& setup : study.data.muscles) setup.start.max_isometric_force_n *= 2.0;
  EXPECT_GT(fit_of_labels(study.data, study.delay_s).r2, 0.9999);
  EXPECT_LT(fit_of_labels(study.data, study.delay_s, "BIC", "TRI").r2, 0.5);
}

TEST(ExchangedElectrodes, OneMuscleHasNobodyToExchangeWith) {
  StudyData data = person(1);
  for (auto& setup : data.muscles) setup.emg_channel = "BIC";
  EXPECT_FALSE(exchanged_electrodes(data, 0.06));
}

}  // namespace
}  // namespace myoid::fit
