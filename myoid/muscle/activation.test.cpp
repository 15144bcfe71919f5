#include "myoid/muscle/activation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::muscle {
namespace {

TEST(Activation, RisesAsTheTwoLagsOfTheClosedForm) {
  // Step of u from 0 to 1: e >= a throughout, so that tau = tau_ac and
  //   a(t) = 1 - (tau_ne exp(-t/tau_ne) - tau_ac exp(-t/tau_ac)) / (tau_ne - tau_ac).
  const ActivationTimes times;
  const double rate_hz = 10000.0;
  Eigen::VectorXd excitation = Eigen::VectorXd::Ones(3000);
  excitation(0) = 1.0;
  ActivationState state;
  for (int k = 1; k <= 3000; ++k) {
    state = step_activation(state, 1.0, 1.0 / rate_hz, times);
    const double t = k / rate_hz;
    const double expected =
        1.0 - (0.040 * std::exp(-t / 0.040) - 0.015 * std::exp(-t / 0.015)) / 0.025;
    // First order in the step: at most half a step times the greatest slope, 1e-4/2 / 0.03
    // = 1.7e-3.
    ASSERT_NEAR(state.activation, expected, 1.7e-3) << t;
  }
}

TEST(Activation, HalvingTheStepHalvesTheError) {
  const auto error = [](double rate_hz) {
    ActivationState state;
    const int n = static_cast<int>(0.05 * rate_hz);
    for (int k = 0; k < n; ++k) state = step_activation(state, 1.0, 1.0 / rate_hz, {});
    const double t = 0.05;
    return state.activation -
           (1.0 - (0.040 * std::exp(-t / 0.040) - 0.015 * std::exp(-t / 0.015)) / 0.025);
  };
  EXPECT_NEAR(error(2000.0) / error(4000.0), 2.0, 0.05);
}

TEST(Activation, FallsMoreSlowlyThanItRises) {
  const ActivationState up = step_activation({1.0, 0.0}, 1.0, 0.015, {});
  EXPECT_NEAR(up.activation, 1.0 - std::exp(-1.0), 1e-12);
  const ActivationState down = step_activation({0.0, 1.0}, 0.0, 0.050, {});
  EXPECT_NEAR(down.activation, std::exp(-1.0), 1e-12);
}

TEST(Activation, StaysWithinZeroAndOneAtAnyRate) {
  ActivationState state;
  for (int k = 0; k < 100; ++k) {
    state = step_activation(state, k % 3 == 0 ? 1.0 : 0.0, 1.0 / 30.0, {});
    EXPECT_GE(state.activation, 0.0);
    EXPECT_LE(state.activation, 1.0);
  }
}

TEST(Activation, AConstantExcitationIsTheActivation) {
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(50, 0.3);
  EXPECT_EQ(activation_from_excitation(u, 100.0), u);
  EXPECT_EQ(two_lag_activation(u, 100.0, 0.03, 0.02), u);
}

TEST(Activation, RatesOfTheOtherLawsHaveTheirPublishedTimeConstants) {
  const ActivationTimes times{.activation_time_s = 0.015, .deactivation_time_s = 0.060};
  // At a = 1/3 the factor 0.5 + 1.5 a is 1: the nominal constants.
  EXPECT_NEAR(thelen_activation_rate(1.0, 1.0 / 3.0, times), (2.0 / 3.0) / 0.015, 1e-12);
  EXPECT_NEAR(thelen_activation_rate(0.0, 1.0 / 3.0, times), -(1.0 / 3.0) / 0.060, 1e-12);
  // The smooth law comes to them far from u = a: tanh(100 * 2/3) is 1 to round-off.
  EXPECT_NEAR(smooth_activation_rate(1.0, 1.0 / 3.0, times, 100.0), (2.0 / 3.0) / 0.015, 1e-10);
  EXPECT_NEAR(smooth_activation_rate(0.0, 1.0 / 3.0, times, 100.0), -(1.0 / 3.0) / 0.060, 1e-10);
  EXPECT_EQ(smooth_activation_rate(0.4, 0.4, times), 0.0);
}

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

TEST(Activation, RefusesTimesThatAreNotPositive) {
  EXPECT_THROW(validate({.activation_time_s = 0.0}), InvalidInput);
  EXPECT_THROW(static_cast<void>(two_lag_activation(Eigen::VectorXd::Ones(3), -1.0, 0.1, 0.1)),
               InvalidInput);
}

}  // namespace
}  // namespace myoid::muscle
