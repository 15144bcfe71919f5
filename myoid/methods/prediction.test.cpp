#include "myoid/methods/prediction.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/identification/parameters.h"
#include "myoid/methods/torque.h"
#include "myoid/posterior/noise_model.h"

#include "tests/support/elbow_study.h"
#include "tests/support/leg_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

/// sqrt(sum_jk C_jk dx/dz_j dx/dz_k) by central differences of the prediction at other unknowns.
template <typename Predicted>
Eigen::VectorXd deviation_by_differences(const IdentificationResult& fit, const Predicted& predicted) {
  const Eigen::Index p = fit.solution.size();
  Eigen::MatrixXd jacobian;
  for (Eigen::Index j = 0; j < p; ++j) {
    const double h = 1e-4 * std::sqrt(fit.covariance(j, j));
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(p, j);
    const Eigen::VectorXd by = (predicted(fit.solution + step) - predicted(fit.solution - step)) / (2.0 * h);
    if (j == 0) jacobian.resize(by.size(), p);
    jacobian.col(j) = by;
  }
  return (jacobian * fit.covariance).cwiseProduct(jacobian).rowwise().sum().cwiseSqrt();
}

TEST(TrialPredictions, DeviationsAreThoseOfTheCovarianceAndTheNoise) {
  const ElbowStudy study =
      elbow_study({.trials = 2, .seconds = 8.0, .emg_cv = 0.08, .torque_sd_nm = 0.6, .with_priors = true});
  EstimatorOptions options{.starts = 1};
  for (const char* channel : {"BIC", "BRA", "BRD", "TRI"}) options.gain_prior_sd[channel] = 0.1;
  const IdentificationResult fit = identify_torque(study.data, options);
  const TrialData& trial = study.data.trials[1];
  const TrialFit found = TrialPredictions(study.data, options, fit).of(trial);
  const ParameterMap map(study.data, options);
  const auto at = [&](const Eigen::VectorXd& z) { return predict(study.data, trial, map.values(z), fit.lag); };
  const Prediction here = at(fit.solution);
  EXPECT_EQ(found.torque_fit_nm, here.torque_nm);
  const Eigen::VectorXd of_parameters = deviation_by_differences(fit, [&](const auto& z) { return at(z).torque_nm; });
  for (Eigen::Index i = 0; i < trial.time_s.size(); i += 37) {
    const double expected = std::sqrt(std::pow(of_parameters[i], 2) + std::pow(fit.torque_sd_nm, 2) +
                                      here.channel_torque_nm.row(i).cwiseAbs2().dot(fit.envelope_variance.transpose()));
    EXPECT_NEAR(found.torque_sd_nm[i], expected, 1e-4 * expected);
  }
  for (Eigen::Index k = 0; k < 4; ++k) {
    const Eigen::VectorXd of_force =
        deviation_by_differences(fit, [&](const auto& z) { return Eigen::VectorXd(at(z).force_n.col(k)); });
    EXPECT_LT((found.force_sd_n.col(k) - of_force).cwiseAbs().maxCoeff(), 1e-4 * of_force.maxCoeff());
  }
}

/// Virtual persons: the bands of trials that took no part hold the measured torque as often as
/// they say, and those of the forces the true forces.
TEST(TrialPredictions, BandsHoldTheTorqueOfTrialsThatTookNoPart) {
  double covered = 0.0, forces = 0.0, count = 0.0;
  for (const EstimatorKind kind : {EstimatorKind::least_squares, EstimatorKind::posterior}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      ElbowStudy study = elbow_study({.trials = 3,
                                      .seconds = 10.0,
                                      .emg_cv = 0.06,
                                      .torque_sd_nm = 0.6,
                                      .truth_from_prior = true,
                                      .with_priors = true,
                                      .seed = seed});
      study.data.trials[2].calibration = false;
      const EstimatorOptions options{.starts = 1, .estimator = kind};
      const IdentificationResult fit = identify_torque(study.data, options);
      const TrialData& trial = study.data.trials[2];
      const TrialFit found = TrialPredictions(study.data, options, fit).of(trial);
      EXPECT_GT(found.score.r2(), 0.8);
      covered += covered_share(trial.torque_nm, found.torque_fit_nm, found.torque_sd_nm);
      const Eigen::MatrixXd truth = predict(study.data, trial, study.truth, study.delay_s).force_n;
      for (Eigen::Index k = 0; k < 4; ++k)
        forces += covered_share(truth.col(k), found.force_fit_n.col(k), found.force_sd_n.col(k)) / 4;
      count += 1.0;
      if (kind == EstimatorKind::least_squares || seed > 1) continue;
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
    EXPECT_GT(covered / count, 0.85) << static_cast<int>(kind);
    EXPECT_GT(forces / count, 0.75) << static_cast<int>(kind);
  }
}

TEST(TrialPredictions, ThePosteriorPredictsAlsoWhatTheUnseenQuantitiesAdd) {
  // Moment arms that are 10 % larger than the study's: the parameters can take that up but for its
  // shape, the unseen quantities with it.
  ElbowStudy study = elbow_study({.trials = 3, .seconds = 10.0, .with_priors = true});
  for (TrialData& trial : study.data.trials) trial.torque_nm *= 1.1;
  study.data.trials[2].calibration = false;
  const EstimatorOptions options{.starts = 1, .estimator = EstimatorKind::posterior};
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
  const EstimatorOptions options{.starts = 1, .estimator = EstimatorKind::posterior};
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
}  // namespace myoid::identification
