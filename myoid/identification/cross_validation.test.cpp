#include "myoid/identification/cross_validation.h"

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(CrossValidate, ATrialThatWasNotFittedIsPredicted) {
  const ElbowStudy study = elbow_study({.emg_cv = 0.05, .torque_sd_nm = 0.5, .with_priors = true});
  const std::vector<Fold> folds = cross_validate(study.data, {.starts = 1});
  ASSERT_EQ(folds.size(), 3U);
  for (std::size_t i = 0; i < folds.size(); ++i) {
    EXPECT_EQ(folds[i].trial, study.data.trials[i].name);
    EXPECT_GT(folds[i].identified.r2, 0.9);
    // Without its fast part the prediction has less of the noise of the EMG.
    EXPECT_LT(folds[i].band.rmse_nm, folds[i].identified.rmse_nm);
    EXPECT_LT(folds[i].identified.rmse_nm, folds[i].literature.rmse_nm);
    EXPECT_LT(folds[i].literature.rmse_nm, folds[i].constant.rmse_nm);
  }
}

TEST(CrossValidate, WhatIsLeftOutDoesNotReachItsOwnPrediction) {
  // Spoil one trial's torque: its own prediction stays what it was.
  ElbowStudy study = elbow_study({.torque_sd_nm = 0.5, .with_priors = true});
  const std::vector<Fold> before = cross_validate(study.data, {.starts = 1});
  study.data.trials[1].torque_nm.array() += 20.0;
  const std::vector<Fold> after = cross_validate(study.data, {.starts = 1});
  EXPECT_EQ((before[1].predicted_nm - after[1].predicted_nm).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT((before[0].predicted_nm - after[0].predicted_nm).cwiseAbs().maxCoeff(), 0.1);
}

TEST(CrossValidate, NeedsTwoTrials) {
  EXPECT_TRUE(cross_validate(elbow_study({.trials = 1, .seconds = 5.0}).data).empty());
}

}  // namespace
}  // namespace myoid::identification
