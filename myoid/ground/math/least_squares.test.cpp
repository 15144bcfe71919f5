#include "myoid/ground/math/least_squares.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/covariance.h"

#include "tests/support/nist_problems.h"

namespace myoid::inline ground::math {
namespace {

using test::NistProblem;

TEST(NistProblems, TheirDataAndCertifiedParametersGiveTheCertifiedResidualSum) {
  // A misprinted datum or parameter would show: the sum is certified to 11 digits, and at the
  // minimum it hardly depends on the last digit of the parameters. Of Lanczos1, fitted to 13
  // digits of data, the parameters' 11 digits leave nothing of the sum; of Lanczos2 four digits.
  for (const std::string& name : test::nist_names()) {
    const NistProblem nist = test::read_nist(name);
    Eigen::VectorXd r(static_cast<Eigen::Index>(nist.response.size()));
    least_squares(nist).evaluate(nist.certified, r, nullptr);
    const double wanted = name == "Lanczos1" ? -20.0 : name == "Lanczos2" ? 3.0 : 8.0;
    EXPECT_GE(test::correct_digits(r.squaredNorm(), nist.residual_sum_of_squares), wanted) << name;
  }
}

TEST(LevenbergMarquardt, FindsNistsCertifiedParametersAndStandardDeviationsFromBothStarts) {
  for (const std::string& name : test::nist_names()) {
    const NistProblem nist = test::read_nist(name);
    ASSERT_EQ(nist.starts.size(), 2U);
    for (std::size_t s = 0; s < nist.starts.size(); ++s) {
      const LeastSquaresResult fit = minimize(least_squares(nist), nist.starts[s], {.max_iterations = 1000});
      const CovarianceResult covariance_of_fit = covariance(fit.jacobian, fit.residual, 1e-14);
      EXPECT_EQ(fit.termination, Termination::converged) << name << " start " << s + 1 << ": " << fit.message;
      for (Eigen::Index j = 0; j < fit.x.size(); ++j) {
        EXPECT_GE(test::correct_digits(fit.x[j], nist.certified[j]), 6.0)
            << name << " start " << s + 1 << " b" << j + 1;
        const double deviation = std::sqrt(covariance_of_fit.unscaled(j, j) * covariance_of_fit.residual_variance);
        EXPECT_GE(test::correct_digits(deviation, nist.standard_deviation[j]), 6.0)
            << name << " start " << s + 1 << " sd of b" << j + 1;
      }
    }
  }
}

TEST(GaussNewton, FindsThemWithFullStepsFromTheNearerStartWhereThoseLead) {
  for (const char* name : {"Misra1a", "Misra1b", "Misra1c", "Misra1d", "DanWood", "BoxBOD", "Rat42", "Chwirut1",
                           "Chwirut2", "Gauss1", "Gauss2", "Kirby2"}) {
    const NistProblem nist = test::read_nist(name);
    const LeastSquaresResult fit = minimize(least_squares(nist), nist.starts[1],
                                            {.method = LeastSquaresMethod::gauss_newton, .max_iterations = 200});
    for (Eigen::Index j = 0; j < fit.x.size(); ++j)
      EXPECT_GE(test::correct_digits(fit.x[j], nist.certified[j]), 6.0) << name << " b" << j + 1;
  }
}

TEST(LevenbergMarquardt, StopsAtABoundAndSaysSo) {
  // y = b1 (1 - exp(-b2 x)) with b1 held below its optimum: the rest is the optimum on that face.
  const NistProblem boxbod = test::read_nist("BoxBOD");
  LeastSquaresProblem problem = least_squares(boxbod);
  problem.lower = Eigen::Vector2d(0.0, 0.0);
  problem.upper = Eigen::Vector2d(200.0, 10.0);
  const LeastSquaresResult fit = minimize(problem, Eigen::Vector2d(100.0, 0.75));
  EXPECT_EQ(fit.termination, Termination::converged);
  EXPECT_TRUE(fit.at_bound[0]);
  EXPECT_FALSE(fit.at_bound[1]);
  EXPECT_EQ(fit.x[0], 200.0);
  EXPECT_NEAR(fit.jacobian.col(1).dot(fit.residual), 0.0, 1e-4);
}

TEST(Minimize, AStepThatABoundMakesUselessIsNoMinimum) {
  // A valley from the start to (2, -2), which a bound at 0.5 closes: the step to its end, cut at the bound, only
  // climbs.
  Eigen::Matrix2d valley;
  valley << 1.0, 0.999, 0.0, 0.05;
  LeastSquaresProblem problem{.residual_count = 2,
                              .evaluate =
                                  [&](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
                                    r = valley * (x - Eigen::Vector2d(2.0, -2.0));
                                    if (jacobian != nullptr) *jacobian = valley;
                                  },
                              .lower = Eigen::Vector2d(-10.0, -10.0),
                              .upper = Eigen::Vector2d(0.5, 10.0)};
  const LeastSquaresResult fit = minimize(problem, Eigen::Vector2d(0.1, 0.1), {.initial_radius = 100.0});
  ASSERT_EQ(fit.termination, Termination::converged) << fit.message;
  // At the bound the second number minimizes (1.5 - 0.999 u)^2 + (0.05 u)^2, u = x + 2. Its square root of the
  // round-off of the cost.
  EXPECT_EQ(fit.x[0], 0.5);
  EXPECT_NEAR(fit.x[1], 1.5 * 0.999 / (0.999 * 0.999 + 0.0025) - 2.0, 1e-7);
}

TEST(Covariance, TwoColumnsThatAreOneAreReportedUndetermined) {
  Eigen::MatrixXd jacobian(5, 3);
  jacobian << 1, 2, 1, 2, 1, 2, 3, 0, 3, 1, 1, 1, 4, 2, 4;
  const CovarianceResult result = covariance(jacobian, Eigen::VectorXd::Ones(5));
  EXPECT_EQ(result.rank, 2);
  ASSERT_EQ(result.undetermined.cols(), 1);
  EXPECT_NEAR(std::abs(result.undetermined(0, 0)), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(result.undetermined(0, 0) + result.undetermined(2, 0), 0.0, 1e-12);
  EXPECT_FALSE(result.determined[0]);
  EXPECT_TRUE(result.determined[1]);
}

TEST(Minimize, RefusesAStartThatIsNotInTheDomain) {
  const NistProblem misra = test::read_nist("Misra1a");
  LeastSquaresProblem problem = least_squares(misra);
  EXPECT_THROW((void)minimize(problem, Eigen::Vector2d(std::nan(""), 1.0)), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
