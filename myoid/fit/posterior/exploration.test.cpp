#include "myoid/fit/posterior/exploration.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/math/draws.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

StudyData person() {
  return test::elbow_study({.trials = 3,
                            .seconds = 10.0,
                            .emg_cv = 0.1,
                            .torque_sd_nm = 0.5,
                            .truth_from_prior = true,
                            .with_priors = true,
                            .seed = 3})
      .data;
}

Eigen::VectorXd mean_of(const Sample& sample) { return sample.z * sample.weight; }

Eigen::VectorXd sd_of(const Sample& sample) {
  return ((sample.z.colwise() - mean_of(sample)).cwiseAbs2() * sample.weight).cwiseSqrt();
}

/// The widths of the 95 % intervals, which long tails do not move as they move standard deviations.
Eigen::VectorXd widths_of(const Sample& sample) {
  Eigen::VectorXd widths(sample.z.rows());
  for (Eigen::Index j = 0; j < widths.size(); ++j) {
    const Eigen::VectorXd z = sample.z.row(j).transpose();
    widths[j] = math::weighted_quantile(z, sample.weight, 0.975) - math::weighted_quantile(z, sample.weight, 0.025);
  }
  return widths;
}

TEST(Explore, TheApproximationAndTheSamplerAgree) {
  const StudyData data = person();
  EstimatorOptions options;
  options.choose_lag = false;
  const Exploration approximate = explore(data, options);
  options.posterior_draws = 2400;
  const Exploration sampled = explore(data, options);
  EXPECT_FALSE(sampled.sample.approximate) << sampled.sample.rhat;
  ASSERT_EQ(approximate.sample.z.rows(), sampled.sample.z.rows());
  const Eigen::VectorXd sd = sd_of(sampled.sample);
  const Eigen::VectorXd shift = (mean_of(approximate.sample) - mean_of(sampled.sample)).cwiseQuotient(sd);
  const Eigen::VectorXd ratio = widths_of(approximate.sample).cwiseQuotient(widths_of(sampled.sample));
  // 2,400 draws know a mean to 0.05 standard deviations. The farthest is a width with a long tail.
  EXPECT_LT(shift.cwiseAbs().maxCoeff(), 0.9);
  EXPECT_LT(shift.cwiseAbs().mean(), 0.2);
  // The tails of two widths and one length are longer than any approximation about a mode says.
  std::vector<double> sorted(ratio.begin(), ratio.end());
  std::sort(sorted.begin(), sorted.end());
  EXPECT_NEAR(sorted[sorted.size() / 2], 1.0, 0.1);
}

TEST(Explore, DrawsHaveTheNoiseOfEveryTrialAndWeightsThatAddToOne) {
  EstimatorOptions options;
  options.marginals = false;
  const Exploration found = explore(person(), options);
  EXPECT_EQ(found.sample.noise.rows(), kNoiseFieldCount + 3);
  EXPECT_NEAR(found.sample.weight.sum(), 1.0, 1e-12);
  double weights = 0.0;
  for (const Candidate& mode : found.modes) weights += mode.weight;
  EXPECT_NEAR(weights, 1.0, 1e-12);
  EXPECT_GE(found.modes.front().weight, found.modes.back().weight);
}

}  // namespace
}  // namespace myoid::fit
