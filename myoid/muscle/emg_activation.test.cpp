#include "myoid/muscle/emg_activation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::muscle {
namespace {

TEST(ShapedActivation, IsZeroAtZeroOneAtOneAndConcave) {
  for (const double shape : {-3.0, -1.5, -1e-3, -1e-5, 0.0}) {
    EXPECT_EQ(shaped_activation(0.0, shape), 0.0);
    EXPECT_NEAR(shaped_activation(1.0, shape), 1.0, 1e-15);
    EXPECT_GE(shaped_activation(0.5, shape), 0.5);
  }
  // A = -2: (e^-1 - 1) / (e^-2 - 1) = 1 / (1 + e^-1).
  EXPECT_NEAR(shaped_activation(0.5, -2.0), 1.0 / (1.0 + std::exp(-1.0)), 1e-15);
  // Series and formula meet at the switch; the next term is A^2/12: 1e-9.
  EXPECT_NEAR(shaped_activation(0.3, -0.99e-4), shaped_activation(0.3, -1.01e-4), 3e-7);
}

TEST(LogLinearActivation, PassesItsNodeWithOneSlope) {
  for (const double shape : {0.01, 0.05, 0.12}) {
    const LogLinearActivation law(shape);
    const double node = 0.3085 - 0.7071 * shape;
    EXPECT_EQ(law(0.0), 0.0);
    EXPECT_NEAR(law(1.0), 1.0, 1e-15);
    EXPECT_NEAR(law(node), 0.3085 + 0.7071 * shape, 1e-13);
    // One-sided differences: truncation h f'' / 2, with f'' below 1e3 before the node.
    const double h = 1e-8;
    EXPECT_NEAR((law(node) - law(node - h)) / h, (law(node + h) - law(node)) / h, 1e-5) << shape;
    EXPECT_GT(law(0.5 * node), 0.5 * law(node));  // concave
  }
}

TEST(LogLinearActivation, IsLinearWithoutShapeAndRefusesMoreThanItsRange) {
  const LogLinearActivation linear(0.0);
  for (const double u : {0.0, 0.2, 0.9}) EXPECT_NEAR(linear(u), u, 1e-15);
  EXPECT_THROW(LogLinearActivation(0.13), InvalidInput);
  EXPECT_THROW(LogLinearActivation(-0.01), InvalidInput);
}

TEST(FreglyActivation, IsTheIdentityWithoutNonlinearityAndKeepsItsEnds) {
  for (const double n : {0.0, 0.3, 1.0}) EXPECT_EQ(fregly_activation(n, 0.0), n);
  EXPECT_NEAR(fregly_activation(0.0, 0.35), 0.0, 2e-8);
  EXPECT_NEAR(fregly_activation(1.0, 0.35), 1.0, 1e-12);
  EXPECT_GT(fregly_activation(0.2, 0.35), 0.2);
}

TEST(TwoLagActivation, IsTheRecursionOfItsPoles) {
  const double rate = 250.0;
  const double t1 = 0.03, t2 = 0.02;
  const double c1 = -std::exp(-1.0 / (rate * t1)), c2 = -std::exp(-1.0 / (rate * t2));
  const double b1 = c1 + c2, b2 = c1 * c2, alpha = 1.0 + b1 + b2;
  Eigen::VectorXd e(60);
  for (int k = 0; k < 60; ++k) e(k) = k < 3 ? 0.0 : 0.5 + 0.4 * std::sin(0.3 * k);
  const Eigen::VectorXd a = two_lag_activation(e, rate, t1, t2);
  double last = 0.0, before = 0.0;
  for (int k = 1; k < 60; ++k) {
    const double expected = alpha * e(k) - b1 * last - b2 * before;
    EXPECT_NEAR(a(k), expected, 1e-14) << k;
    before = last;
    last = expected;
  }
}

TEST(TwoLagActivation, DoesNotDependOnTheRate) {
  // A step, 100 ms on: 1 - (t1 e^(-t/t1) - t2 e^(-t/t2)) / (t1 - t2); first order in the interval.
  const double expected = 1.0 - (0.05 * std::exp(-2.0) - 0.02 * std::exp(-5.0)) / 0.03;
  for (const int rate : {1000, 4000}) {
    Eigen::VectorXd step = Eigen::VectorXd::Ones(rate / 10 + 1);
    step(0) = 0.0;
    const Eigen::VectorXd a = two_lag_activation(step, rate, 0.05, 0.02);
    EXPECT_NEAR(a(a.size() - 1), expected, 8.0 / rate) << rate;
  }
}

TEST(TwoLagActivation, RefusesTimesThatAreNotPositive) {
  EXPECT_THROW(static_cast<void>(two_lag_activation(Eigen::VectorXd::Ones(3), -1.0, 0.1, 0.1)),
               InvalidInput);
  EXPECT_THROW(static_cast<void>(two_lag_activation(Eigen::VectorXd::Ones(3), 100.0, 0.0, 0.1)),
               InvalidInput);
}

}  // namespace
}  // namespace myoid::muscle
