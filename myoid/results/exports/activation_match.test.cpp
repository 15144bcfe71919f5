#include "myoid/results/exports/activation_match.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/opensim/projects/ceinms_law.h"
#include "myoid/results/exports/foreign_law.h"

namespace myoid::results {
namespace {

std::vector<double> levels() {
  std::vector<double> values;
  for (int k = 0; k <= 100; ++k) values.push_back(0.01 * k);
  return values;
}

fit::ChannelValues channel(double gain, double shape, double exponent) {
  fit::ChannelValues values{};
  values[fit::kDelay] = 0.05;
  values[fit::kGain] = gain;
  values[fit::kShape] = shape;
  values[fit::kExponent] = exponent;
  values[fit::kExcitationTime] = 0.04;
  values[fit::kActivationTime] = 0.015;
  values[fit::kDeactivationTime] = 0.05;
  return values;
}

TEST(CeinmsActivation, HoldsGainAndShapeExactlyWhereTheExponentIsOne) {
  const CeinmsActivation linear = ceinms_activation(channel(1.2, 0.0, 1.0), fit::EmgLag::delay, levels(), 100.0);
  EXPECT_EQ(linear.delay_s, 0.05);
  EXPECT_EQ(linear.c1, 0.0);
  EXPECT_EQ(linear.scale, 1.2);
  EXPECT_LT(linear.shape_factor, 0.0);  // 0 / 0 in CEINMS
  const CeinmsActivation bent = ceinms_activation(channel(0.8, -2.0, 1.0), fit::EmgLag::delay, levels(), 100.0);
  for (const double u : levels())
    EXPECT_NEAR(bent.scale * opensim::exponential_shape(u, bent.shape_factor),
                (std::exp(-2.0 * 0.8 * u) - 1.0) / (std::exp(-2.0) - 1.0), 1e-14);
}

TEST(CeinmsActivation, HasTheRootsOfTheLagsAtTheRateOfTheSamples) {
  const CeinmsActivation own = ceinms_activation(channel(1.0, 0.0, 1.0), fit::EmgLag::equation_1, levels(), 200.0);
  EXPECT_NEAR(own.c1, -std::exp(-0.005 / 0.04), 1e-15);
  EXPECT_NEAR(own.c2, -std::exp(-0.005 / (0.5 * (0.015 + 0.05))), 1e-15);
  EXPECT_EQ(own.delay_s, 0.05);
  // A shared delay of 82.5 ms has a part of 10 ms that is no lag.
  fit::ChannelValues whole = channel(1.0, 0.0, 1.0);
  whole[fit::kDelay] = 0.0825;
  const CeinmsActivation shared = ceinms_activation(whole, fit::EmgLag::shared, levels(), 200.0);
  EXPECT_NEAR(shared.delay_s, 0.010, 1e-15);
  EXPECT_NEAR(shared.c1, -std::exp(-0.005 / 0.04), 1e-15);
}

TEST(CeinmsActivation, IsTheNearestExponentialToAPower) {
  const CeinmsActivation found = ceinms_activation(channel(1.1, 0.0, 0.7), fit::EmgLag::delay, levels(), 100.0);
  const auto distance = [&](double shape, double scale) {
    double sum = 0.0;
    for (const double u : levels()) {
      const double e = 1.1 * std::pow(u, 0.7) - scale * opensim::exponential_shape(u, shape);
      sum += e * e;
    }
    return sum;
  };
  const double least = distance(found.shape_factor, found.scale);
  EXPECT_LT(found.shape_factor, 0.0);
  for (const double step : {-0.01, 0.01}) {
    EXPECT_GT(distance(found.shape_factor + step, found.scale), least);
    EXPECT_GT(distance(found.shape_factor, found.scale + step), least);
  }
  EXPECT_LT(std::sqrt(least / 101.0), 0.03);
}

TEST(NmsmNumbers, KeepTheMeanLagAndTheScaleOfAProportionalActivation) {
  const NmsmActivation found = nmsm_numbers(channel(0.9, 0.0, 1.0), fit::EmgLag::equation_1, 0.5, levels());
  EXPECT_EQ(found.nonlinearity, 0.0);
  EXPECT_EQ(found.emg_scale, 0.45);
  const double slower = 1.0 / (0.75 * 0.45 * 0.5 + 0.25);  // the mean of the levels is 0.5
  EXPECT_NEAR(found.delay_s + slower * found.time_constant_s, 0.05 + 0.04 + 0.0325, 1e-12);
  EXPECT_GE(found.time_constant_s, 0.0075);
  EXPECT_LE(found.time_constant_s, 0.035);
}

TEST(NmsmNumbers, BendAsAConcavePowerDoes) {
  const NmsmActivation found = nmsm_numbers(channel(1.0, 0.0, 0.8), fit::EmgLag::delay, 1.0, levels());
  EXPECT_GT(found.nonlinearity, 0.0);
  double bent = 0.0, straight = 0.0;
  for (const double u : levels()) {
    bent += std::pow(std::pow(u, 0.8) - nmsm_activation(found.emg_scale * u, found.nonlinearity), 2);
    straight += std::pow(std::pow(u, 0.8) - found.emg_scale * u, 2);
  }
  EXPECT_LT(bent, 0.5 * straight);
}

}  // namespace
}  // namespace myoid::results
