#include "myoid/identification/study_data.h"

#include <gtest/gtest.h>

#include "myoid/identification/cross_validation.h"
#include "myoid/identification/paper.h"
#include "myoid/identification/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(IncludedRows, LeaveOutTheIntervalsWithTheirEnds) {
  TrialData trial;
  trial.time_s = Eigen::VectorXd::LinSpaced(11, 0.0, 10.0);
  EXPECT_EQ(included_rows(trial).size(), 11u);
  trial.excluded = {{-1.0, 1.0}, {4.0, 5.5}};
  EXPECT_EQ(included_rows(trial), (std::vector<Eigen::Index>{2, 3, 6, 7, 8, 9, 10}));
}

/// Torque and forces are wrong by a factor in a stretch that the study leaves out.
ElbowStudy spoiled_study(bool excluded) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 20.0, .rate_hz = 50.0});
  for (TrialData& trial : study.data.trials) {
    for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
      if (trial.time_s[i] < 6.0 || trial.time_s[i] > 9.0) continue;
      trial.torque_nm[i] *= 0.5;
      trial.force_n.row(i) *= 0.5;
    }
    if (excluded) trial.excluded = {{5.99, 9.01}};
  }
  return study;
}

double worst_error(const ElbowStudy& study, const IdentificationResult& result) {
  double worst = 0.0;
  for (std::size_t m = 0; m < study.truth.size(); ++m) {
    for (std::size_t f = 0; f < 6; ++f) {
      const auto member = muscle::kHillFields[f].member;
      worst = std::max(worst, std::abs(result.muscles[m].*member / (study.truth[m].*member) - 1.0));
    }
  }
  return worst;
}

TEST(ExcludedIntervals, DoNotTouchTheEstimates) {
  const TorqueOptions exact{
      .priors = false, .residual_cutoff_hz = std::nullopt, .weights = false, .starts = 1};
  const ElbowStudy spoiled = spoiled_study(false);
  EXPECT_GT(worst_error(spoiled, identify_torque(spoiled.data, exact)), 0.02);
  const ElbowStudy excluded = spoiled_study(true);
  const IdentificationResult result = identify_torque(excluded.data, exact);
  EXPECT_LT(worst_error(excluded, result), 1e-6);
  // Scored without it too: the prediction is right wherever it counts.
  for (const TrialFit& fit : result.trials) EXPECT_LT(fit.rmse_nm, 1e-5);
}

TEST(ExcludedIntervals, AreNeitherScoredInFoldsNorSampledByThePaper) {
  const ElbowStudy excluded = spoiled_study(true);
  const TorqueOptions exact{
      .priors = false, .residual_cutoff_hz = std::nullopt, .weights = false, .starts = 1};
  for (const Fold& fold : cross_validate(excluded.data, exact, {})) {
    EXPECT_EQ(fold.time_s.size(), 1001 - 151);
    EXPECT_LT(fold.identified.rmse_nm, 0.01);
  }
  const ElbowStudy whole = elbow_study({.trials = 2, .seconds = 20.0, .rate_hz = 50.0});
  EXPECT_LT(identify_paper(excluded.data, {}).samples_used,
            identify_paper(whole.data, {}).samples_used);
}

}  // namespace
}  // namespace myoid::identification
