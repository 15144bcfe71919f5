#include "myoid/fit/methods/prediction.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/fit/posterior/noise_model.h"

#include "tests/support/elbow_study.h"
#include "tests/support/leg_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;

/// Virtual persons: the bands of trials that took no part hold the measured torque as often as
/// they say, and those of the forces the true forces.
TEST(TrialPredictions, BandsHoldTheTorqueOfTrialsThatTookNoPart) {
  double covered = 0.0, forces = 0.0, count = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    ElbowStudy study = elbow_study({.trials = 3,
                                    .seconds = 10.0,
                                    .emg_cv = 0.06,
                                    .torque_sd_nm = 0.6,
                                    .truth_from_prior = true,
                                    .with_priors = true,
                                    .seed = seed});
    study.data.trials[2].calibration = false;
    const EstimatorOptions options;
    const IdentificationResult fit = identify_torque(study.data, options);
    const TrialData& trial = study.data.trials[2];
    const TrialFit found = TrialPredictions(study.data, options, fit).of(trial);
    EXPECT_GT(found.score.r2(), 0.8);
    covered += covered_share(trial.torque_nm, found.torque_fit_nm, found.torque_sd_nm);
    const Eigen::MatrixXd truth = predict(study.data, trial, study.truth, study.delay_s).force_n;
    for (Eigen::Index k = 0; k < 4; ++k)
      forces += covered_share(truth.col(k), found.force_fit_n.col(k), found.force_sd_n.col(k)) / 4;
    count += 1.0;
    if (seed > 1) continue;
    // The forces are the law's from the drive, and differ from the law's from the noisy envelope.
    TrialData driven = trial;
    driven.activation = found.drive;
    const double largest_n = found.force_fit_n.maxCoeff();
    const auto off = [&](const TrialData& by) {
      return (predict(study.data, by, fit.values, fit.lag).force_n - found.force_fit_n).cwiseAbs().maxCoeff();
    };
    EXPECT_LT(off(driven), 1e-4 * largest_n);
    EXPECT_GT(off(trial), 1e-2 * largest_n);
  }
  EXPECT_GT(covered / count, 0.85);
  EXPECT_GT(forces / count, 0.75);
}

TEST(TrialPredictions, ThePosteriorPredictsAlsoWhatTheUnseenQuantitiesAdd) {
  // Moment arms that are 10 % larger than the study's: the parameters can take that up but for its
  // shape, the unseen quantities with it.
  ElbowStudy study = elbow_study({.trials = 3, .seconds = 10.0, .with_priors = true});
  for (TrialData& trial : study.data.trials) trial.torque_nm *= 1.1;
  study.data.trials[2].calibration = false;
  const EstimatorOptions options;
  const IdentificationResult fit = identify_torque(study.data, options);
  ASSERT_EQ(fit.noise.size(), kNoiseFieldCount + 2);  // and the shares of two fitted trials
  const TrialData& trial = study.data.trials[2];
  const TrialFit found = TrialPredictions(study.data, options, fit).of(trial);
  const Score by_law = score(trial.torque_nm, predict(study.data, trial, fit.values, fit.lag).torque_nm);
  EXPECT_LE(found.score.rmse_nm(), by_law.rmse_nm());
  EXPECT_GT(found.score.r2(), 0.99);
}

TEST(TrialPredictions, ThePosteriorPredictsEveryJointOfATrialThatTookNoPart) {
  ElbowStudy study = test::leg_study({.trials = 3, .torque_sd_nm = 1.0});
  study.data.trials[2].calibration = false;
  const EstimatorOptions options;
  const IdentificationResult fit = identify_torque(study.data, options);
  ASSERT_EQ(fit.trials.size(), 6U);
  for (const std::size_t j : {0U, 1U}) {
    const TrialFit& found = fit.trials[4 + j];
    EXPECT_EQ(found.joint, j == 0 ? "ankle" : "knee");
    EXPECT_GT(found.score.r2(), 0.98) << found.joint;
    // 95 %, of a torque whose errors are correlated: some 50 independent samples.
    EXPECT_GT(covered_share(found.torque_nm, found.torque_fit_nm, found.torque_sd_nm), 0.85) << found.joint;
  }
}

TEST(CoveredShare, CountsWhatLiesWithinTheBand) {
  const Eigen::VectorXd measured = Eigen::VectorXd::LinSpaced(5, 0.0, 4.0);
  EXPECT_DOUBLE_EQ(covered_share(measured, Eigen::VectorXd::Zero(5), Eigen::VectorXd::Ones(5)), 0.4);
  EXPECT_TRUE(std::isnan(covered_share(measured, measured, {})));
}

}  // namespace
}  // namespace myoid::fit
