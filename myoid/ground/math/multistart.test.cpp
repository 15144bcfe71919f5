#include "myoid/ground/math/multistart.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/sobol.h"

#include "tests/support/nist_problems.h"

namespace myoid::inline ground::math {
namespace {

/// r = (x^2 - 1, s (x - 1)) per parameter: minima near -1 and at +1, the latter with cost 0.
LeastSquaresProblem double_wells(Eigen::Index p, double s) {
  LeastSquaresProblem problem;
  problem.residual_count = 2 * p;
  problem.evaluate = [p, s](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    if (j != nullptr) j->setZero();
    for (Eigen::Index k = 0; k < p; ++k) {
      r[2 * k] = x[k] * x[k] - 1.0;
      r[2 * k + 1] = s * (x[k] - 1.0);
      if (j != nullptr) {
        (*j)(2 * k, k) = 2.0 * x[k];
        (*j)(2 * k + 1, k) = s;
      }
    }
  };
  return problem;
}

/// Sobol points of a box.
std::vector<Eigen::VectorXd> points(Eigen::Index count, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::MatrixXd cube = sobol_points(count, static_cast<int>(lower.size()), {.first = 1, .scramble_seed = {}});
  std::vector<Eigen::VectorXd> starts;
  for (Eigen::Index i = 0; i < count; ++i)
    starts.emplace_back(lower + cube.row(i).transpose().cwiseProduct(upper - lower));
  return starts;
}

/// Fits from one start; a start at which the residual is not finite fails.
LocalSearch fits(const LeastSquaresProblem& problem) {
  return [problem](const Eigen::VectorXd& start) {
    try {
      const LeastSquaresResult fit = minimize(problem, start);
      return LocalMinimum{fit.termination, fit.x, fit.cost, fit.evaluations};
    } catch (const InvalidInput&) {
      return LocalMinimum{.termination = Termination::not_finite, .x = start};
    }
  };
}

MultistartOptions box(Eigen::Index count, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  return {.starts = points(count, lower, upper), .lower = lower, .upper = upper};
}

TEST(Multistart, FindsEveryBasinOfDoubleWellsInOrderOfCost) {
  // Three parameters, two wells each: 8 minima. dC/dx = 0 besides x = 1: 2x(x+1) + s^2 = 0.
  const double s = 0.1;
  const double left = (-1.0 - std::sqrt(1.0 - 2.0 * s * s)) / 2.0;
  const double cost = 0.5 * (std::pow(left * left - 1.0, 2) + s * s * std::pow(left - 1.0, 2));
  const MultistartResult result =
      multistart(fits(double_wells(3, s)), box(64, Eigen::Vector3d::Constant(-2.0), Eigen::Vector3d::Constant(2.0)));
  ASSERT_EQ(result.basins.size(), 8U);
  Eigen::Index members = 0;
  for (std::size_t b = 0; b < 8; ++b) {
    const Basin& basin = result.basins[b];
    // Costs are 0, 1, 1, 1, 2, 2, 2, 3 times that of one left well.
    const double wells = b == 0 ? 0.0 : b < 4 ? 1.0 : b < 7 ? 2.0 : 3.0;
    EXPECT_NEAR(basin.cost, wells * cost, 1e-10);
    for (const double x : basin.x) EXPECT_NEAR(x, x > 0.0 ? 1.0 : left, 1e-6);
    EXPECT_EQ(basin.converged, static_cast<Eigen::Index>(basin.members.size()));
    members += static_cast<Eigen::Index>(basin.members.size());
  }
  EXPECT_EQ(members, 64);
  EXPECT_TRUE(result.failed.empty());
}

TEST(Multistart, GivesTheSameOnOneThreadAndOnMany) {
  const MultistartOptions options = box(40, Eigen::Vector4d::Constant(-3.0), Eigen::Vector4d::Constant(2.0));
  const MultistartResult many = multistart(fits(double_wells(4, 0.2)), options);
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const MultistartResult single = multistart(fits(double_wells(4, 0.2)), options);
  ASSERT_EQ(many.basins.size(), single.basins.size());
  for (std::size_t b = 0; b < many.basins.size(); ++b) {
    EXPECT_EQ(many.basins[b].x, single.basins[b].x);
    EXPECT_EQ(many.basins[b].members, single.basins[b].members);
  }
  for (std::size_t i = 0; i < many.minima.size(); ++i)
    EXPECT_EQ(many.minima[i].evaluations, single.minima[i].evaluations);
}

TEST(Multistart, FindsNistsCertifiedMinimumOfGauss3FromABox) {
  // Two Gaussian peaks that may swap their names: the box keeps them in order.
  const test::NistProblem nist = test::read_nist("Gauss3");
  MultistartOptions options = box(16, 0.5 * nist.certified, 1.6 * nist.certified);
  // Positive parameters: the starts are spread evenly in the logarithms.
  options.starts = points(16, options.lower.array().log().matrix(), options.upper.array().log().matrix());
  for (Eigen::VectorXd& start : options.starts) start = start.array().exp().matrix().eval();
  const MultistartResult result = multistart(fits(least_squares(nist)), options);
  ASSERT_FALSE(result.basins.empty());
  for (Eigen::Index j = 0; j < 8; ++j) EXPECT_NEAR(result.basins.front().x[j] / nist.certified[j], 1.0, 1e-6);
  EXPECT_NEAR(2.0 * result.basins.front().cost / nist.residual_sum_of_squares, 1.0, 1e-9);
}

TEST(Multistart, StartsOutsideTheDomainAreCountedNotFatal) {
  // r = log(x): the left half of the box is outside.
  LeastSquaresProblem problem;
  problem.residual_count = 1;
  problem.evaluate = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r[0] = std::log(x[0]);
    if (j != nullptr) (*j)(0, 0) = 1.0 / x[0];
  };
  const MultistartResult result =
      multistart(fits(problem), box(16, Eigen::VectorXd::Constant(1, -2.0), Eigen::VectorXd::Constant(1, 2.0)));
  ASSERT_EQ(result.basins.size(), 1U);
  EXPECT_NEAR(result.basins[0].x[0], 1.0, 1e-9);
  EXPECT_EQ(result.failed.size() + result.basins[0].members.size(), 16U);
  EXPECT_GE(result.failed.size(), 7U);
}

TEST(Multistart, RefusesBoxesThatAreNone) {
  const LocalSearch search = [](const Eigen::VectorXd& x) { return LocalMinimum{.x = x}; };
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  EXPECT_THROW((void)multistart(search, {.starts = {one}}), InvalidInput);
  EXPECT_THROW((void)multistart(search, {.starts = {one}, .lower = one, .upper = -one}), InvalidInput);
  EXPECT_THROW((void)multistart(search, {.lower = -one, .upper = one}), InvalidInput);
  EXPECT_THROW((void)multistart(search, {.starts = {{}}, .lower = -one, .upper = one}), InvalidInput);
  std::stop_source stop;
  stop.request_stop();
  MultistartOptions options{.starts = {one}, .lower = -one, .upper = one};
  options.progress.stop = stop.get_token();
  EXPECT_THROW((void)multistart(search, options), Interrupted);
}

}  // namespace
}  // namespace myoid::inline ground::math
