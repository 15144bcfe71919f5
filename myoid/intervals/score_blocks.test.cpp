#include "myoid/intervals/score_blocks.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/intervals/uncertainty.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

TEST(StudentFactor, IsThatOfTheTables) {
  // t at 97.5 %: 4: 2.7764, 10: 2.2281, 30: 2.0423 (any table), over 1.95996.
  EXPECT_NEAR(std::sqrt(student_factor(4.0)) * 1.959964, 2.776445, 1e-6);
  EXPECT_NEAR(std::sqrt(student_factor(10.0)) * 1.959964, 2.228139, 1e-6);
  EXPECT_NEAR(std::sqrt(student_factor(30.0)) * 1.959964, 2.042272, 1e-6);
  EXPECT_EQ(student_factor(0.5), student_factor(3.0));
}

TEST(BlockCovariance, HoldsTheErrorsOfPlainLeastSquares) {
  // One muscle of four without priors or weights, again and again with new noise: errors over
  // standard errors have a mean square of 1, of 24 x 3 known to 0.17 to 0.29 (independent or not).
  // The quantile of 15 blocks makes it some 0.85.
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 30.0, .seed = 5});
    test::StudyNoise noise(seed);
    TrialData& trial = study.data.trials[0];
    trial.torque_nm += 1.0 * noise.band(trial.time_s.size(), 1.5, 100.0);
    for (MuscleSetup& setup : study.data.muscles) {
      setup.start = study.truth[static_cast<std::size_t>(&setup - study.data.muscles.data())];
      setup.fixed = {"concentric_curvature", "eccentric_curvature_product", "eccentric_plateau"};
    }
    const Estimator estimator(
        study.data, {.muscles = {"TRI"}, .priors = false, .delay_s = study.delay_s, .weights = false, .starts = 1});
    const Eigen::VectorXd truth = estimator.model().parameters().start();
    const Estimator::Solution solution = estimator.solve(truth);
    const Sandwich parts = sandwich(estimator, solution);
    const Eigen::VectorXd error = solution.search.x - truth;
    for (Eigen::Index j = 0; j < error.size(); ++j) {
      sum += error[j] * error[j] / parts.newey_west(j, j);
      ++count;
    }
  }
  EXPECT_EQ(count, 72);
  EXPECT_LT(sum / count, 1.35);
  EXPECT_GT(sum / count, 0.5);
}

}  // namespace
}  // namespace myoid::identification
