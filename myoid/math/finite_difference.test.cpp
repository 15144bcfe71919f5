#include "myoid/math/finite_difference.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/math/random.h"

#include "tests/support/nist_problems.h"

namespace myoid::math {
namespace {

TEST(FiniteDifference, GradientOfAnalyticFunctionsIsRightToItsOwnErrorEstimate) {
  // f = exp(x) sin(y) + x y^3 + 1/(1 + z^2).
  const auto f = [](const Eigen::VectorXd& x) {
    return std::exp(x[0]) * std::sin(x[1]) + x[0] * std::pow(x[1], 3) + 1.0 / (1.0 + x[2] * x[2]);
  };
  for (const double z : {0.0, 0.3, -2.0, 40.0}) {
    const Eigen::Vector3d x(0.7, -1.2, z);
    const Eigen::Vector3d exact(std::exp(0.7) * std::sin(-1.2) + std::pow(-1.2, 3),
                                std::exp(0.7) * std::cos(-1.2) + 0.7 * 3.0 * 1.44,
                                -2.0 * z / std::pow(1.0 + z * z, 2));
    const GradientEstimate found = gradient_by_differences(f, x);
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(found.value[j], exact[j], 1e-10) << z << " " << j;
      EXPECT_LE(std::abs(found.value[j] - exact[j]), 20.0 * found.error[j] + 1e-14);
      EXPECT_LT(found.error[j], 1e-9);
    }
    EXPECT_LE(found.evaluations, 1 + 3 * 18);
  }
}

TEST(FiniteDifference, JacobiansOfAllNistProblemsAgreeWithTheirExactDerivatives) {
  // Exact ones by automatic differentiation. Residuals are rounded at 1e-16 of the responses.
  for (const std::string& name : test::nist_names()) {
    const test::NistProblem nist = test::read_nist(name);
    const LeastSquaresProblem problem = test::least_squares(nist);
    const Eigen::VectorXd b = nist.certified;
    Eigen::VectorXd r(problem.residual_count);
    Eigen::MatrixXd exact(problem.residual_count, b.size());
    problem.evaluate(b, r, &exact);
    const JacobianEstimate found = jacobian_by_differences(
        [&](const Eigen::VectorXd& at) {
          Eigen::VectorXd residual(problem.residual_count);
          problem.evaluate(at, residual, nullptr);
          return residual;
        },
        b, {.scale = b.cwiseAbs()});
    EXPECT_LT(jacobian_discrepancy(exact, found), 1e-8) << name;
    exact.col(0) *= 1.0 + 1e-5;
    EXPECT_GT(jacobian_discrepancy(exact, found), 1e-6) << name;
  }
}

TEST(FiniteDifference, StaysWithinBoundsAndGoesOneSidedAtOne) {
  // sqrt is not defined left of zero; at the bound x = 1 only x >= 1 may be asked.
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  const auto f = [&](const Eigen::VectorXd& x) {
    least = std::min(least, x[0]);
    most = std::max(most, x[0]);
    return std::sqrt(x[0]);
  };
  const auto at = [&](double x, double low, double high) {
    least = std::numeric_limits<double>::infinity();
    most = -least;
    return gradient_by_differences(
        f, Eigen::VectorXd::Constant(1, x),
        {.lower = Eigen::VectorXd::Constant(1, low), .upper = Eigen::VectorXd::Constant(1, high)});
  };
  EXPECT_NEAR(at(1.0, 1.0, 9.0).value[0], 0.5, 1e-8);
  EXPECT_GE(least, 1.0);
  EXPECT_NEAR(at(1.0, 0.0, 1.0).value[0], 0.5, 1e-8);
  EXPECT_LE(most, 1.0);
  EXPECT_NEAR(at(1.0, 0.999, 9.0).value[0], 0.5, 1e-9);  // the step is cut to the bound
  EXPECT_GE(least, 0.999);
  const GradientEstimate stuck = at(1.0, 1.0, 1.0);
  EXPECT_EQ(stuck.error[0], std::numeric_limits<double>::infinity());
}

TEST(FiniteDifference, StepsOutOfTheDomainArePassedOver) {
  // log at 0.005: the first steps (0.02 ...) leave the domain.
  const GradientEstimate found = gradient_by_differences(
      [](const Eigen::VectorXd& x) { return std::log(x[0]); }, Eigen::VectorXd::Constant(1, 0.005));
  EXPECT_NEAR(found.value[0], 200.0, 1e-4);
}

TEST(FiniteDifference, SeesPastAKinkThatLiesBesideThePoint) {
  // Steps of 0.02 to 0.0025 straddle the kink at 0.001; 0.000625 and less do not.
  const GradientEstimate found =
      gradient_by_differences([](const Eigen::VectorXd& x) { return std::abs(x[0] - 1e-3); },
                              Eigen::VectorXd::Zero(1), {.refinements = 12});
  EXPECT_NEAR(found.value[0], -1.0, 1e-10);
}

TEST(FiniteDifference, NoiseShowsInItsErrorEstimate) {
  // f = x^2 + noise of 1e-7: the derivative is known to about 1e-7 / step.
  const GradientEstimate found = gradient_by_differences(
      [](const Eigen::VectorXd& x) {
        return x[0] * x[0] + 1e-7 * Random(std::bit_cast<std::uint64_t>(x[0])).normal();
      },
      Eigen::VectorXd::Ones(1));
  EXPECT_LE(std::abs(found.value[0] - 2.0), 5.0 * found.error[0]);
  EXPECT_GT(found.error[0], 1e-8);
  EXPECT_LT(found.error[0], 1e-3);
}

TEST(FiniteDifference, RefusesPointsAndOptionsThatAreNone) {
  const ScalarFunction f = [](const Eigen::VectorXd& x) { return x.sum(); };
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  EXPECT_THROW((void)gradient_by_differences(f, std::nan("") * one), InvalidInput);
  EXPECT_THROW((void)gradient_by_differences(f, one, {.lower = 2.0 * one}), InvalidInput);
  EXPECT_THROW((void)gradient_by_differences(f, one, {.scale = Eigen::VectorXd::Ones(2)}),
               InvalidInput);
  EXPECT_THROW((void)gradient_by_differences(f, one, {.first_step = 0.0}), InvalidInput);
  int calls = 0;
  EXPECT_THROW(
      (void)jacobian_by_differences(
          [&](const Eigen::VectorXd&) { return Eigen::VectorXd(Eigen::VectorXd::Ones(++calls)); },
          one),
      InvalidInput);
}

}  // namespace
}  // namespace myoid::math
