#include "myoid/fit/methods/cross_validation.h"

#include <gtest/gtest.h>

#include "myoid/fit/methods/prediction.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(CrossValidate, ATrialThatWasNotFittedIsPredicted) {
  const ElbowStudy study = elbow_study({.emg_cv = 0.05, .torque_sd_nm = 0.5, .with_priors = true});
  const std::vector<Fold> folds = cross_validate(study.data, identify_torque, {});
  ASSERT_EQ(folds.size(), 3U);
  for (std::size_t i = 0; i < folds.size(); ++i) {
    EXPECT_EQ(folds[i].trial, study.data.trials[i].name);
    EXPECT_GT(folds[i].identified.r2(), 0.9);
    // Without its fast part the prediction has less of the noise of the EMG.
    EXPECT_LT(folds[i].band.rmse_nm(), folds[i].identified.rmse_nm());
    EXPECT_LT(folds[i].identified.rmse_nm(), folds[i].literature.rmse_nm());
    EXPECT_LT(folds[i].literature.rmse_nm(), folds[i].constant.rmse_nm());
  }
}

TEST(CrossValidate, WhatIsLeftOutDoesNotReachItsOwnPrediction) {
  // Spoil one trial's torque: its own prediction stays what it was.
  ElbowStudy study = elbow_study({.torque_sd_nm = 0.5, .with_priors = true});
  const std::vector<Fold> before = cross_validate(study.data, identify_torque, {});
  study.data.trials[1].torque_nm.array() += 20.0;
  const std::vector<Fold> after = cross_validate(study.data, identify_torque, {});
  EXPECT_EQ((before[1].predicted_nm - after[1].predicted_nm).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT((before[0].predicted_nm - after[0].predicted_nm).cwiseAbs().maxCoeff(), 0.1);
}

TEST(CrossValidate, AMaximalContractionIsInEveryFitAndNeverLeftOut) {
  StudyData data = elbow_study({.trials = 3, .seconds = 5.0}).data;
  data.trials[1].reference = true;
  for (TrialData& trial : data.trials) trial.condition = "one";
  data.trials[2].condition = "other";
  for (const FoldKind kind : {FoldKind::trial, FoldKind::condition, FoldKind::block}) {
    const std::vector<Split> all = splits(data, {.kind = kind});
    ASSERT_EQ(all.size(), kind == FoldKind::block ? 5U : 2U);
    for (const Split& split : all) {
      const auto whole = std::ranges::count_if(split.data.trials, [&](const TrialData& t) {
        return t.reference && t.calibration && t.time_s.size() == data.trials[1].time_s.size();
      });
      EXPECT_EQ(whole, 1) << split.name;
      EXPECT_EQ(std::ranges::count(split.data.trials, true, &TrialData::reference), 1) << split.name;
    }
  }
}

TEST(CrossValidate, NeedsTwoTrials) {
  EXPECT_TRUE(cross_validate(elbow_study({.trials = 1, .seconds = 5.0}).data, identify_torque, {}).empty());
}

TEST(CrossValidate, AFoldIsTheReportedFitOnTheOtherTrialsAndScoresItsPlainPrediction) {
  const ElbowStudy study = elbow_study({.emg_cv = 0.08, .torque_sd_nm = 0.8, .with_priors = true});
  const EstimatorOptions options{.choose_lag = true};
  const std::vector<Fold> folds = cross_validate(study.data, identify_torque, options);
  StudyData others = study.data;
  TrialData& left = others.trials[0];
  left.calibration = false;
  const EstimatorOptions of_fold = of_a_fold(options);
  const IdentificationResult fit = identify_torque(others, of_fold);
  ASSERT_EQ(folds[0].parameters.size(), fit.estimates.size());
  for (std::size_t j = 0; j < fit.estimates.size(); ++j)
    EXPECT_EQ(folds[0].parameters[j].estimate, fit.estimates[j].estimate);
  EXPECT_EQ(folds[0].lag, fit.lag);
  const Eigen::VectorXd torque = TrialPredictions(others, of_fold, fit).of(left).torque_fit_nm;
  EXPECT_EQ(folds[0].identified.r2(), score(left.torque_nm, torque).r2());
}

TEST(CrossValidate, TrialsThatAreTooShortForBlocksAreNotCut) {
  std::string why_not;
  const StudyData brief = elbow_study({.trials = 2, .seconds = 2.0}).data;
  EXPECT_TRUE(splits(brief, {.kind = FoldKind::block}, &why_not).empty());
  EXPECT_EQ(why_not,
            "no trial has the 3.3 s from which blocks are left out; whole trials can be: set folds to \"trial\"");
  StudyData mixed = elbow_study({.trials = 1, .seconds = 10.0}).data;
  mixed.trials.push_back(brief.trials[0]);
  const std::vector<Split> all = splits(mixed, {.kind = FoldKind::block}, &why_not);
  ASSERT_EQ(all.size(), 5U);
  EXPECT_TRUE(why_not.empty());
  for (const Split& split : all) {
    double held_s = 0.0, seen_s = 0.0;
    for (const TrialData& t : split.data.trials)
      (t.calibration ? seen_s : held_s) += t.time_s[t.time_s.size() - 1] - t.time_s[0];
    EXPECT_NEAR(held_s, 2.0, 0.02);
    EXPECT_GT(seen_s, 2.0 + 0.5 * 10.0);  // the short trial whole, and half of the long one
  }
}

TEST(CrossValidate, NamesTheOtherPartOnlyIfItCanBeLeftOut) {
  const auto reason = [](int trials, double seconds, FoldKind kind) {
    std::string why_not;
    EXPECT_TRUE(
        splits(elbow_study({.trials = trials, .seconds = seconds}).data, {.kind = kind, .setting = "--folds"}, &why_not)
            .empty());
    return why_not;
  };
  EXPECT_EQ(reason(1, 5.0, FoldKind::trial),
            "there is only one trial to fit; blocks of it can be: set --folds to \"block\"");
  for (const FoldKind kind : {FoldKind::trial, FoldKind::block, FoldKind::condition}) {
    const std::string text = reason(1, 2.0, kind);
    EXPECT_EQ(text.find("--folds"), std::string::npos) << text;
    EXPECT_NE(text.find("its 2 s are too short for blocks"), std::string::npos) << text;
    EXPECT_NE(text.find("record a second trial, or one of 3.3 s or more"), std::string::npos) << text;
  }
}

/// Two channels that are held at these levels for 2 s, one second of silence before and after.
TrialData efforts(bool calibration, double flexor, double extensor) {
  TrialData t;
  t.calibration = calibration;
  t.time_s = Eigen::VectorXd::LinSpaced(201, 0.0, 4.0);
  const Eigen::VectorXd clock = Eigen::VectorXd::LinSpaced(501, -1.0, 4.0);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(clock.size(), 2);
  for (Eigen::Index i = 0; i < clock.size(); ++i) {
    if (clock[i] >= 1.0 && clock[i] <= 3.0) a.row(i) << flexor, extensor;
  }
  a(10, 0) = 50.0;  // ahead of the trial
  t.activation = TimeSeries(clock, {{"F", Unit::dimensionless}, {"E", Unit::dimensionless}}, std::move(a));
  return t;
}

StudyData study_of(std::vector<TrialData> trials) {
  StudyData data;
  data.muscles.resize(2);
  data.muscles[0].emg_channel = "F";
  data.muscles[1].emg_channel = "E";
  data.trials = std::move(trials);
  return data;
}

TEST(UnseenEffort, IsTheChannelThatWorksHardestBeyondWhatWasFitted) {
  const UnseenEffort found =
      unseen_effort(study_of({efforts(true, 0.2, 0.4), efforts(true, 0.1, 0.5), efforts(false, 0.3, 1.0)}));
  EXPECT_EQ(found.channel, "E");
  EXPECT_NEAR(found.ratio, 2.0, 1e-12);
}

TEST(UnseenEffort, IsNoneWhereTheFitSawGreaterEfforts) {
  const UnseenEffort found = unseen_effort(study_of({efforts(true, 0.8, 0.9), efforts(false, 0.3, 0.4)}));
  EXPECT_EQ(found.channel, "");
  EXPECT_EQ(found.ratio, 1.0);
}

}  // namespace
}  // namespace myoid::fit
