#include "myoid/intervals/profile_likelihood.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

/// C = 1/2 x'Hx about (1, 2, 3).
ProfileProblem quadratic(const Eigen::Matrix3d& h) {
  const Eigen::Vector3d minimum(1.0, 2.0, 3.0);
  return {.cost =
              [h, minimum](const Eigen::VectorXd& z, Eigen::VectorXd& gradient) {
                gradient = h * (z - minimum);
                return 0.5 * (z - minimum).dot(gradient);
              },
          .lower = Eigen::Vector3d::Constant(-1e3),
          .upper = Eigen::Vector3d::Constant(1e3),
          .minimum = minimum,
          .gradient = Eigen::Vector3d::Zero(),
          .curvature = h};
}

Eigen::Matrix3d curvature() {
  Eigen::Matrix3d h;
  h << 4.0, 1.8, -0.5, 1.8, 1.0, 0.3, -0.5, 0.3, 2.0;
  return h;
}

TEST(ProfileLikelihood, OfAQuadraticReachesAsFarAsTheInverseOfItsCurvatureSays) {
  const Eigen::Matrix3d covariance = curvature().inverse();
  ProfileProblem problem = quadratic(curvature());
  for (Eigen::Index j = 0; j < 3; ++j) {
    const double expected = kNormal95 * std::sqrt(covariance(j, j));
    EXPECT_NEAR(profile_distance(problem, j, false).value(), expected, 1e-9 * expected);
    EXPECT_NEAR(profile_distance(problem, j, true).value(), expected, 1e-9 * expected);
  }
  // A curvature that is given too small, too large, without its ties: 0.02 of C are 0.5 % of v.
  const Eigen::Matrix3d apart = curvature().diagonal().asDiagonal();
  for (const Eigen::Matrix3d& wrong : {Eigen::Matrix3d(0.4 * curvature()), Eigen::Matrix3d(3.0 * curvature()), apart}) {
    problem.curvature = wrong;
    for (Eigen::Index j = 0; j < 3; ++j) {
      const double expected = kNormal95 * std::sqrt(covariance(j, j));
      EXPECT_NEAR(profile_distance(problem, j, true).value(), expected, 0.01 * expected);
    }
  }
}

TEST(ProfileLikelihood, ReachesAsManyStandardErrorsAsItsGoalIs) {
  const Eigen::Matrix3d covariance = curvature().inverse();
  ProfileProblem problem = quadratic(curvature());
  problem.curvature = curvature().diagonal().asDiagonal();  // so that there is something to search
  for (const double goal : {0.2, 1.0, 3.0, 12.0}) {
    const double expected = goal * std::sqrt(covariance(1, 1));
    EXPECT_NEAR(profile_distance(problem, 1, true, goal).value(), expected, 0.01 * expected);
  }
}

TEST(ProfileLikelihood, EndsWhereABoundIsAndNotedWhereTheOthersMeetTheirs) {
  ProfileProblem problem = quadratic(curvature());
  problem.upper[0] = 1.3;
  EXPECT_FALSE(profile_distance(problem, 0, true));  // 3.84 would be reached at 1 + 2.6
  EXPECT_TRUE(profile_distance(problem, 0, false));
  problem.lower[2] = 3.0;  // z_2 cannot follow: then z_0 and z_1 alone say where
  problem.upper[2] = 3.0;
  const Eigen::Matrix2d left = curvature().topLeftCorner<2, 2>().inverse();
  const double expected = kNormal95 * std::sqrt(left(1, 1));
  EXPECT_NEAR(profile_distance(problem, 1, true).value(), expected, 0.005 * expected);
}

TEST(ProfileLikelihood, WhereOneMeetsItsBoundTheRestAnswersToThat) {
  // z_0 and z_2 go together, by 5 for each 1 of z_1; z_2 may go 0.05. Then z_0 goes where
  // dC/dz_0 = 0, (5 t + 99 0.05) / 100. Cut off without an answer, z_0 would climb out of the valley.
  Eigen::Matrix3d h;
  h << 100.0, -5.0, -99.0, -5.0, 60.0, -5.0, -99.0, -5.0, 100.0;
  ProfileProblem problem = quadratic(h);
  problem.upper[2] = 3.05;
  // That they follow z_1 is not known beforehand: the search begins where they are.
  problem.curvature(0, 1) = problem.curvature(1, 0) = 0.0;
  problem.curvature(2, 1) = problem.curvature(1, 2) = 0.0;
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.5 * (low + high);
    const Eigen::Vector3d d((5.0 * t + 99.0 * 0.05) / 100.0, t, 0.05);
    (std::sqrt(d.dot(h * d)) < kNormal95 ? low : high) = t;
  }
  EXPECT_NEAR(profile_distance(problem, 1, true).value(), low, 0.005 * low);
}

TEST(ProfileLikelihood, FollowsACurvedValley) {
  // C = 1/2 ((x - 1)^2 / 0.3^2 + ((y - x^2) / 0.01)^2), minimum at (1, 1). Given x, y follows at no
  // cost: x = 1 +- 1.96 0.3. Given y, C is least near x = sqrt(y), by a fine search.
  const auto cost = [](double x, double y) {
    return 0.5 * (std::pow((x - 1.0) / 0.3, 2) + std::pow((y - x * x) / 0.01, 2));
  };
  const auto slopes = [](const Eigen::VectorXd& z) {
    const double off = (z[1] - z[0] * z[0]) / 1e-4;
    return Eigen::Vector2d((z[0] - 1.0) / 0.09 - 2.0 * z[0] * off, off);
  };
  Eigen::Matrix2d h;
  h << 1.0 / 0.09 + 4.0 / 1e-4, -2.0 / 1e-4, -2.0 / 1e-4, 1.0 / 1e-4;
  const ProfileProblem problem{.cost =
                                   [&](const Eigen::VectorXd& z, Eigen::VectorXd& gradient) {
                                     gradient = slopes(z);
                                     return cost(z[0], z[1]);
                                   },
                               .lower = Eigen::Vector2d(0.0, -5.0),
                               .upper = Eigen::Vector2d(5.0, 25.0),
                               .minimum = Eigen::Vector2d(1.0, 1.0),
                               .gradient = Eigen::Vector2d::Zero(),
                               .curvature = h};
  for (const bool above : {false, true})
    EXPECT_NEAR(profile_distance(problem, 0, above).value(), kNormal95 * 0.3, 0.01 * kNormal95 * 0.3);
  const auto profiled = [&](double y) {
    double least = 1e300;
    for (int i = -2000; i <= 2000; ++i) least = std::min(least, cost(std::sqrt(y) + 1e-5 * i, y));
    return std::sqrt(2.0 * least);
  };
  for (const bool above : {false, true}) {
    double low = 0.0, high = above ? 4.0 : 0.99;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (profiled(1.0 + (above ? middle : -middle)) < kNormal95 ? low : high) = middle;
    }
    EXPECT_NEAR(profile_distance(problem, 1, above).value(), low, 0.01 * low) << above;
  }
}

TEST(ProfileLikelihood, OfARecordingIsWhereFitsWithThatParameterHeldAreWorseByWhatIsAskedFor) {
  const test::ElbowStudy study = test::elbow_study({.trials = 5,
                                                    .seconds = 8.0,
                                                    .emg_cv = 0.06,
                                                    .torque_sd_nm = 0.5,
                                                    .truth_from_prior = true,
                                                    .with_priors = true});
  const Estimator estimator(study.data, {.starts = 1});
  const Estimator::Solution solution = estimator.solve(estimator.model().parameters().start());
  const Eigen::VectorXd rise = Eigen::VectorXd::LinSpaced(solution.search.x.size(), 0.4, 2.0);
  const Eigen::VectorXd variance = rise.cwiseProduct(sandwich(estimator, solution).model_based.diagonal());
  const std::vector<Interval> intervals = profile(estimator, solution, variance);
  int checked = 0;
  for (std::size_t j = 0; j < intervals.size(); j += 3) {
    for (const std::optional<double>& end : {intervals[j].low, intervals[j].high}) {
      if (!end) continue;
      Eigen::VectorXd start = solution.search.x;
      start[static_cast<Eigen::Index>(j)] = *end;
      std::vector<bool> held(intervals.size(), false);
      held[j] = true;
      // Levenberg-Marquardt, of which the profile uses nothing. v to 2 %.
      const NormalSearchResult fit = estimator.search(start, solution.weighting, 1e-9, 1e-11, 200, {}, held);
      const double goal = kNormal95 * std::sqrt(rise[static_cast<Eigen::Index>(j)]);
      EXPECT_NEAR(std::sqrt(2.0 * (fit.cost - solution.search.cost)), goal, 0.02 * goal)
          << estimator.free()[j].label << " " << *end;
      ++checked;
    }
  }
  EXPECT_GT(checked, 12);
}

}  // namespace
}  // namespace myoid::identification
