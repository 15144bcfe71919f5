#include "myoid/ground/math/halved_steps.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

/// r = atan(x): full steps diverge from |x| > 1.3917, and the minimum is 0.
LeastSquaresProblem arcus_tangent() {
  LeastSquaresProblem problem;
  problem.residual_count = 1;
  problem.evaluate = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    r[0] = std::atan(x[0]);
    if (jacobian != nullptr) (*jacobian)(0, 0) = 1.0 / (1.0 + x[0] * x[0]);
  };
  return problem;
}

TEST(HalvedSteps, ConvergeWhereFullOnesDiverge) {
  const LeastSquaresProblem problem = arcus_tangent();
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(1, 3.0);
  const LeastSquaresResult full = minimize(problem, start, {.method = LeastSquaresMethod::gauss_newton});
  EXPECT_FALSE(std::abs(full.x[0]) < 1.0) << "nothing is shown";
  const LeastSquaresResult found = minimize_by_halved_steps(problem, start);
  EXPECT_EQ(found.termination, Termination::converged) << found.message;
  EXPECT_NEAR(found.x[0], 0.0, 1e-9);
  for (std::size_t i = 1; i < found.cost_history.size(); ++i)
    EXPECT_LT(found.cost_history[i], found.cost_history[i - 1]);
}

TEST(HalvedSteps, EndAtTheMinimumOfACostThatIsNotZeroThere) {
  // r = (x - 1, x + 1, x^2): d/dx (2 x^2 + 2 + x^4) / 2 = 0 at x = 0, where the cost is 1.
  LeastSquaresProblem problem;
  problem.residual_count = 3;
  problem.evaluate = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    r << x[0] - 1.0, x[0] + 1.0, x[0] * x[0];
    if (jacobian != nullptr) jacobian->col(0) << 1.0, 1.0, 2.0 * x[0];
  };
  const LeastSquaresResult found = minimize_by_halved_steps(problem, Eigen::VectorXd::Constant(1, 5.0));
  EXPECT_EQ(found.termination, Termination::converged) << found.message;
  EXPECT_NEAR(found.x[0], 0.0, 1e-5);
  EXPECT_NEAR(found.cost, 1.0, 1e-11);
}

TEST(HalvedSteps, AStartThatIsNotFiniteIsRefused) {
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW((void)minimize_by_halved_steps(arcus_tangent(), start), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
