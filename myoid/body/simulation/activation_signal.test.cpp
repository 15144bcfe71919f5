#include "myoid/body/simulation/activation_signal.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/activation_steps.h"

namespace myoid::body {
namespace {

using test::step_activation;

using muscle::ActivationDynamics;
using muscle::ActivationLaw;

constexpr ActivationLaw kLaws[] = {ActivationLaw::two_lags, ActivationLaw::thelen, ActivationLaw::de_groote,
                                   ActivationLaw::recursive};

const Burst kBursts[] = {{0.1, 0.15, 0.9}, {0.4, 0.05, 0.3}, {0.6, 0.3, 1.0}};

// The law's own exact step for held excitations is the oracle; de_groote's is good to 1e-7.
TEST(ActivationSignal, FollowsBurstsAsTheExactStepsDo) {
  for (const ActivationLaw law : kLaws) {
    const ActivationDynamics<double> dynamics{.law = law};
    const Signal u = bursts(kBursts, 0.05);
    const ActivationSignal a(dynamics, u, 0.0, 1.2);
    ASSERT_EQ(a.status(), math::OdeStatus::done);
    auto exact = muscle::settled_activation(0.05);
    std::size_t hint = 0;
    for (int k = 0; k < 1200; ++k) {  // jumps lie on this grid
      EXPECT_NEAR(a.at(0.001 * k, hint), exact.activation, 2e-7) << "t " << 0.001 * k;
      exact = step_activation(dynamics, value_at(u, 0.001 * k + 0.0005), exact, 0.001);
    }
  }
}

TEST(ActivationSignal, OfTheEnvelopeIsTheExcitationItself) {
  const Signal u = bursts(kBursts, 0.05);
  const ActivationSignal a({.law = ActivationLaw::envelope}, u, 0.0, 1.2);
  std::size_t hint = 0;
  for (const double t : {0.0, 0.1, 0.2, 0.25, 0.7, 0.3}) EXPECT_NEAR(a.at(t, hint), value_at(u, t), 1e-15) << t;
}

// A sine sampled at 1 kHz through two equal rises: gain and lag of two first-order lags.
TEST(ActivationSignal, DenseSamplesPassAsThroughTwoLags) {
  Signal u;
  const double omega = 2.0 * 3.141592653589793 * 2.0;
  for (int k = 0; k <= 3000; ++k) {
    u.time_s.push_back(0.001 * k);
    u.value.push_back(0.5 + 0.4 * std::sin(omega * 0.001 * k));
  }
  const ActivationDynamics<double> d{.law = ActivationLaw::recursive};
  const ActivationSignal a(d, u, 0.0, 3.0);
  const double gain = 1.0 / std::sqrt((1.0 + std::pow(omega * 0.040, 2)) * (1.0 + std::pow(omega * 0.015, 2)));
  const double lag = std::atan(omega * 0.040) + std::atan(omega * 0.015);
  std::size_t hint = 0;
  for (double t = 2.0; t < 3.0; t += 0.0137) {
    // Chords between samples lie below the sine by (omega dt)^2 / 8 of its amplitude: 2e-5.
    EXPECT_NEAR(a.at(t, hint), 0.5 + 0.4 * gain * std::sin(omega * t - lag), 2e-5);
  }
}

}  // namespace
}  // namespace myoid::body
