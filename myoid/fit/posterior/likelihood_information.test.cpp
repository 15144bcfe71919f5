#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "myoid/fit/posterior/likelihood.h"

#include "tests/support/crowded_study.h"
#include "tests/support/leg_study.h"

namespace myoid::fit {
namespace {

using test::crowded_options;
using test::crowded_study;
using test::ElbowStudy;
using test::kNoise;
using test::leg_study;

TEST(Likelihood, TheForecastOfOneJointIsItsPartOfTheForecastOfAll) {
  const ElbowStudy study = leg_study({.seconds = 6.0, .torque_sd_nm = 1.0});
  const Likelihood likelihood(study.data, {});
  const ParameterMap& map = likelihood.parameters();
  const Eigen::VectorXd z = map.start();
  const Likelihood::UnseenGiven given = likelihood.unseen_given(z, kNoise);
  EXPECT_GT(given.mean.norm(), 0.1);
  const auto forecast = [&](const TrialData& trial) {
    return likelihood.forecast(whole_run(trial, study.data, {}, map), z, kNoise, given);
  };
  const TrialData& trial = study.data.trials[1];
  const Likelihood::RunForecast all = forecast(trial);
  const Eigen::Index n = trial.time_s.size();
  for (const std::size_t j : {0U, 1U}) {
    const Likelihood::RunForecast one = forecast(of_joint(trial, j));
    const Eigen::Index first = static_cast<Eigen::Index>(j) * n;
    // Up to the order of sums.
    EXPECT_LT((all.mean_nm.segment(first, n) - one.mean_nm).norm(), 1e-12 * one.mean_nm.norm());
    EXPECT_LT((all.by_z.middleRows(first, n) - one.by_z).norm(), 1e-12 * one.by_z.norm());
    EXPECT_LT((all.variance_nm2.segment(first, n) - one.variance_nm2).norm(), 1e-12 * one.variance_nm2.norm());
    EXPECT_EQ(all.force_n, one.force_n);
  }
}

TEST(Likelihood, TheInformationOfTrialsAddsToThatOfAllWhereTheUnseenIsIntegratedOver) {
  const ElbowStudy study = crowded_study();
  const Likelihood likelihood(study.data, crowded_options());
  const Eigen::VectorXd z = likelihood.parameters().start();
  const std::vector<Eigen::MatrixXd> trials = likelihood.information_by_trial(z, kNoise);
  ASSERT_EQ(trials.size(), 2U);
  const Eigen::Index p = z.size(), q = trials[0].rows() - p;
  const Eigen::MatrixXd sum = trials[0] + trials[1];
  // Schur's complement of the quantities, whose precision is 1 beforehand.
  const Eigen::MatrixXd of_unseen = sum.bottomRightCorner(q, q) + Eigen::MatrixXd::Identity(q, q);
  const Eigen::MatrixXd left =
      sum.topLeftCorner(p, p) - sum.topRightCorner(p, q) * of_unseen.ldlt().solve(sum.bottomLeftCorner(q, p));
  const Eigen::MatrixXd whole = likelihood.information(z, kNoise).information;
  EXPECT_LT((left - whole).norm(), 1e-8 * whole.norm());
}

TEST(Likelihood, TheSharesOfTheSourcesAddToTheInformation) {
  const ElbowStudy study = crowded_study();
  const Likelihood likelihood(study.data, crowded_options());
  const Eigen::VectorXd z = likelihood.parameters().start();
  const Likelihood::Information found = likelihood.information(z, kNoise);
  EXPECT_GT(found.information(0, 0), 0.0);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(z.size(), z.size());
  for (const Eigen::MatrixXd& part : found.by_source) sum += part;
  EXPECT_LT((sum - found.information).norm(), 1e-9 * sum.norm());
  for (const Eigen::MatrixXd& part : found.by_source) EXPECT_GE(part.diagonal().minCoeff(), -1e-9 * sum.norm());
}

}  // namespace
}  // namespace myoid::fit
