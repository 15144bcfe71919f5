#include "myoid/identification/loss.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

/// Mean of f(u) over normal residuals, trapezoids over +-9.
template <typename F>
double normal_mean(F f) {
  constexpr double kStep = 1e-3;
  double sum = 0.0;
  for (double u = -9.0; u <= 9.0; u += kStep) sum += f(u) * std::exp(-0.5 * u * u) * kStep / std::sqrt(2.0 * M_PI);
  return sum;
}

TEST(Loss, TheWeightIsHalfTheSlopeOfRhoOverTheResidual) {
  for (const Loss kind : {Loss::square, Loss::huber, Loss::cauchy}) {
    for (const double u : {-7.0, -1.5, -0.4, 0.3, 1.2, 2.0, 40.0}) {
      constexpr double kStep = 1e-6;
      const double slope = (loss(kind, u + kStep).rho - loss(kind, u - kStep).rho) / (2.0 * kStep);
      EXPECT_NEAR(loss(kind, u).weight, 0.5 * slope / u, 1e-6);
    }
  }
}

TEST(Loss, AsGoodAsTheSquareBy95PercentForNormalResiduals) {
  // Asymptotic efficiency of an M-estimator of location: (E psi')^2 / E psi^2, psi = u weight;
  // E psi' = E u psi for a normal u (Stein).
  for (const Loss kind : {Loss::huber, Loss::cauchy}) {
    const auto psi = [&](double u) { return u * loss(kind, u).weight; };
    const double slope = normal_mean([&](double u) { return u * psi(u); });
    const double square = normal_mean([&](double u) { return psi(u) * psi(u); });
    EXPECT_NEAR(slope * slope / square, 0.95, 5e-4);
  }
}

TEST(Loss, AnOutlierPullsNoMoreThanItsBoundAndLessAndLess) {
  EXPECT_NEAR(1e6 * loss(Loss::huber, 1e6).weight, 1.345, 1e-9);
  EXPECT_LT(1e6 * loss(Loss::cauchy, 1e6).weight, 1e-4);
  EXPECT_EQ(loss(Loss::square, 1e6).weight, 1.0);
}

}  // namespace
}  // namespace myoid::identification
