#include "myoid/identification/normal_search.h"

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

TEST(NormalSearch, FindsTheMinimumThatAnalysisGives) {
  // r = (x - 3, 10 (y - x^2)): minimum 0 at (3, 9); with x <= 2: r = (-1, 0) at (2, 4).
  const NormalFunction rosenbrock = [](const Eigen::VectorXd& z) -> NormalEquations {
    const Eigen::Vector2d r(z[0] - 3.0, 10.0 * (z[1] - z[0] * z[0]));
    Eigen::Matrix2d j;
    j << 1.0, 0.0, -20.0 * z[0], 10.0;
    return {0.5 * r.squaredNorm(), j.transpose() * r, j.transpose() * j};
  };
  const Eigen::Vector2d low(-10.0, -10.0), high(10.0, 100.0), start(-1.2, 1.0);
  const NormalSearchResult free = minimize_normal(rosenbrock, low, high, start);
  EXPECT_EQ(free.termination, math::Termination::converged);
  EXPECT_NEAR(free.x[0], 3.0, 1e-9);
  EXPECT_NEAR(free.x[1], 9.0, 1e-8);
  const NormalSearchResult bound = minimize_normal(rosenbrock, low, Eigen::Vector2d(2.0, 100.0), start);
  EXPECT_NEAR(bound.x[0], 2.0, 1e-12);
  EXPECT_NEAR(bound.x[1], 4.0, 1e-8);
  EXPECT_TRUE(bound.at_bound[0]);
  EXPECT_NEAR(bound.cost, 0.5, 1e-12);
}

}  // namespace
}  // namespace myoid::identification
