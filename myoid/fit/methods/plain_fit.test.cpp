#include "myoid/fit/methods/plain_fit.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(FewSamples, AreRowsOfTheTrialsInOrder) {
  StudyData data = elbow_study({.trials = 2, .seconds = 60.0}).data;
  data.trials.push_back(part(data.trials[1], 100, 40));
  data.trials[1].calibration = false;
  const StudyData few = few_samples(data, 300);
  ASSERT_EQ(few.trials.size(), 3U);
  EXPECT_EQ(few.trials[1].time_s.size(), data.trials[1].time_s.size());
  EXPECT_NEAR(static_cast<double>(few.trials[0].time_s.size()), 298.0, 5.0);
  EXPECT_GE(few.trials[2].time_s.size(), 8) << "a short trial counts too";
  for (const std::size_t t : {0U, 2U}) {
    const TrialData& whole = data.trials[t];
    Eigen::Index row = 0;
    for (Eigen::Index i = 0; i < few.trials[t].time_s.size(); ++i, ++row) {
      while (row < whole.time_s.size() && whole.time_s[row] != few.trials[t].time_s[i]) ++row;
      ASSERT_LT(row, whole.time_s.size()) << "sample " << i << " is none of the trial's, or late";
      EXPECT_EQ(few.trials[t].length_m.row(i), whole.length_m.row(row));
      EXPECT_EQ(few.trials[t].torque_nm[i], whole.torque_nm[row]);
    }
  }
}

TEST(FewSamples, AreAllWhereThereAreNoMore) {
  const StudyData data = elbow_study({.trials = 1, .seconds = 2.0}).data;
  EXPECT_EQ(few_samples(data, 500).trials[0].time_s, data.trials[0].time_s);
}

TEST(FewSamples, SeeEveryPhaseOfAMovementWhoseStridesAreTheStepBetweenThem) {
  const StudyData data = elbow_study({.trials = 1, .seconds = 100.0}).data;
  const Eigen::VectorXd time_s = few_samples(data, 200).trials[0].time_s;
  for (const double strides : {1.0, 2.0, 3.0}) {
    std::vector<double> phase;
    for (const double t : time_s) phase.push_back(std::fmod(t * strides / 0.5, 1.0));
    std::sort(phase.begin(), phase.end());
    double gap = phase.front() + 1.0 - phase.back();
    for (std::size_t i = 1; i < phase.size(); ++i) gap = std::max(gap, phase[i] - phase[i - 1]);
    // Rows are 0.01 s apart: at three strides in 0.5 s that alone is 0.06.
    EXPECT_LT(gap, 0.1) << strides;
  }
}

TEST(PlainFit, LongTrialsGiveTheTruthBack) {
  const ElbowStudy study = elbow_study({.trials = 2, .seconds = 60.0, .with_priors = true});
  const std::optional<IdentificationResult> found = exact_fit(study.data, {});
  ASSERT_TRUE(found);
  const IdentificationResult& result = *found;
  EXPECT_GT(result.samples_used, 10000) << "the answer is of all samples";
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t f = 0; f < 6; ++f) {
      const auto member = muscle::kHillFields[f].member;
      const double truth = study.truth[k].*member;
      EXPECT_NEAR(result.muscles[k].*member, truth, 1e-6 * truth) << muscle::kHillFields[f].name;
    }
  }
}

TEST(PlainFit, ASpoiledSampleAmongTheManyIsSeen) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 60.0, .with_priors = true});
  ASSERT_TRUE(exact_fit(study.data, {}));
  // One torque in 12 002, which the few samples need not hold.
  const Eigen::VectorXd held = few_samples(study.data, 500).trials[0].time_s;
  TrialData& trial = study.data.trials[0];
  Eigen::Index row = 3000;
  while (std::find(held.begin(), held.end(), trial.time_s[row]) != held.end()) ++row;
  trial.torque_nm[row] += 1.0;
  EXPECT_FALSE(exact_fit(study.data, {}));
}

TEST(PlainFit, NoiseOfAThousandthIsNoise) {
  const ElbowStudy study = elbow_study({.trials = 1, .seconds = 30.0, .torque_sd_nm = 0.02, .with_priors = true});
  EXPECT_FALSE(exact_fit(study.data, {}));
}

}  // namespace
}  // namespace myoid::fit
