#include "myoid/posterior/importance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/math/random.h"

namespace myoid::identification {
namespace {

/// Order statistics of a generalized Pareto distribution by its own quantile function.
Eigen::VectorXd pareto_quantiles(double shape, double scale, Eigen::Index n) {
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    x[i] = shape == 0.0 ? -scale * std::log(1.0 - share)
                        : scale * (std::pow(1.0 - share, -shape) - 1.0) / shape;
  }
  return x;
}

TEST(Importance, FindsShapeAndScaleOfAParetoTail) {
  for (const double shape : {-0.2, 0.0, 0.3, 0.9}) {
    const ParetoFit fit = fit_pareto(pareto_quantiles(shape, 2.5, 4000));
    EXPECT_NEAR(fit.shape, shape, 0.02);
    EXPECT_NEAR(fit.scale, 2.5, 0.06);
  }
}

TEST(Importance, QuantilesOfAParetoDistributionAreThoseOfItsFormula) {
  EXPECT_NEAR((ParetoFit{.shape = 0.5, .scale = 2.0}.quantile(0.75)), 4.0, 1e-12);
  EXPECT_NEAR((ParetoFit{.shape = 0.0, .scale = 2.0}.quantile(0.5)), 2.0 * std::log(2.0), 1e-12);
}

TEST(Importance, KhatOfRatiosWithAKnownTail) {
  // Ratios r = u^-k have a Pareto tail of shape k.
  math::Random random(7);
  for (const double shape : {0.3, 1.0}) {
    Eigen::VectorXd log_ratio(20000);
    for (double& v : log_ratio) v = -shape * std::log(1.0 - random.uniform());
    EXPECT_NEAR(smooth_weights(log_ratio).khat, shape, 0.12);
  }
}

TEST(Importance, EqualRatiosHaveEqualWeights) {
  const SmoothedWeights weights = smooth_weights(Eigen::VectorXd::Constant(100, 3.0));
  EXPECT_LT(weights.khat, 0.0);
  EXPECT_NEAR(weights.effective(), 100.0, 1e-9);
}

TEST(Importance, MeanSpreadAndQuantilesOfASkewedDensity) {
  // Logarithms of gamma variables of shape 4, proposed from a normal about the mode: their mean is
  // the digamma function at 4, 1.25612, their variance the trigamma function, 0.28382.
  const auto log_density = [](const Eigen::VectorXd& x) {
    return (4.0 * x.array() - x.array().exp()).sum();
  };
  const Eigen::Index d = 3;
  const Eigen::VectorXd mode = Eigen::VectorXd::Constant(d, std::log(4.0));
  const Draws draws = draw(log_density, mode, Eigen::MatrixXd::Identity(d, d) / 4.0, 20000, 3);
  ASSERT_FALSE(draws.approximate);
  EXPECT_LT(draws.khat, 0.7);
  for (Eigen::Index j = 0; j < d; ++j) {
    const Eigen::VectorXd x = draws.x.row(j);
    const double mean = x.dot(draws.weight);
    EXPECT_NEAR(mean, 1.25612, 0.02);
    EXPECT_NEAR((x.array() - mean).square().matrix().dot(draws.weight), 0.28382, 0.02);
    // The median of a gamma variable of shape 4 is 3.67206.
    EXPECT_NEAR(weighted_quantile(x, draws.weight, 0.5), std::log(3.67206), 0.02);
  }
}

TEST(Importance, SaysWhereTheProposalCannotBeTrusted) {
  // Cauchy tails in twelve dimensions beside a normal that is far too narrow.
  const auto log_density = [](const Eigen::VectorXd& x) {
    return -(1.0 + (x / 30.0).array().square()).log().sum();
  };
  const Eigen::Index d = 12;
  const Draws draws =
      draw(log_density, Eigen::VectorXd::Zero(d), Eigen::MatrixXd::Identity(d, d), 1000, 5);
  EXPECT_TRUE(draws.approximate);
  EXPECT_GE(draws.khat, 0.7);
  EXPECT_NEAR(draws.weight.sum(), 1.0, 1e-12);
}

}  // namespace
}  // namespace myoid::identification
