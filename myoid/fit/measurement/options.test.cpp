#include "myoid/fit/measurement/options.h"

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

TEST(EstimatorSettings, DefaultsAreThoseOfTheEstimatorButForTheLagThatTheDataChoose) {
  const EstimatorOptions made = estimator_options({}, {}, {});
  const EstimatorOptions plain;
  EXPECT_TRUE(made.choose_lag);
  EXPECT_EQ(made.law, plain.law);
  EXPECT_EQ(made.delay_prior_mean_s, plain.delay_prior_mean_s);
  EXPECT_EQ(made.delay_prior_sd_s, plain.delay_prior_sd_s);
  EXPECT_EQ(made.max_rate_hz, plain.max_rate_hz);
  EXPECT_EQ(made.residual_cutoff_hz, plain.residual_cutoff_hz);
  EXPECT_EQ(made.from_mvc, plain.from_mvc);
  EXPECT_EQ(made.envelope_cutoff_hz, plain.envelope_cutoff_hz);
  EXPECT_TRUE(made.channels.empty());
}

TEST(EstimatorSettings, WithTheLagsOfEquation1TheDelayIsTheTimeLeftBesideThem) {
  const EstimatorOptions lags = estimator_options({.lag = LagChoice::equation_1}, {}, {});
  EXPECT_FALSE(lags.choose_lag);
  EXPECT_EQ(lags.law, EmgLag::equation_1);
  EXPECT_NEAR(lags.delay_prior_mean_s, 0.010, 1e-12);
  EXPECT_NEAR(lags.delay_prior_sd_s, 0.010, 1e-12);
}

TEST(EstimatorSettings, AChannelWithoutAnErrorOfItsLevelHasNoGain) {
  ActivationSource source;
  source.channels = {{.channel = "BIC", .bandwidth_hz = 90.0, .rest = 0.01},
                     {.channel = "TRI", .gain_sd = 0.05, .gain_mean = 0.8}};
  const EstimatorOptions made = estimator_options({}, source, {});
  EXPECT_FALSE(made.of("BIC").gain_sd);
  EXPECT_EQ(made.of("TRI").gain_sd, 0.05);
  EXPECT_EQ(made.of("TRI").gain_mean, 0.8);
  EXPECT_EQ(made.of("BIC").bandwidth_hz, 90.0);
  EXPECT_EQ(made.rest_level("BIC"), 0.01);
}

}  // namespace
}  // namespace myoid::fit
