#include "myoid/muscle/activation.h"

#include <cmath>
#include <random>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/activation_steps.h"

namespace myoid::muscle {
namespace {

using test::step_activation;

using Dynamics = ActivationDynamics<double>;
using Point = ActivationPoint<double>;

constexpr ActivationLaw kLaws[] = {ActivationLaw::envelope,  ActivationLaw::two_lags,  ActivationLaw::thelen,
                                   ActivationLaw::de_groote, ActivationLaw::recursive, ActivationLaw::one_lag};

/// Euler steps, Richardson-extrapolated from n, 2n and 4n of them: another algorithm.
Point by_small_steps(const Dynamics& d, double u, const Point& from, double interval_s, int n) {
  const auto euler = [&](int steps) {
    Point s = from;
    const double h = interval_s / steps;
    for (int k = 0; k < steps; ++k) {
      const Point r = activation_rate(d, u, s);
      s.filtered_excitation += h * r.filtered_excitation;
      s.activation += h * r.activation;
    }
    return s;
  };
  const Point a = euler(n), b = euler(2 * n), c = euler(4 * n);
  const auto extrapolated = [](double x, double y, double z) {
    const double first = 2.0 * y - x, second = 2.0 * z - y;
    return second + (second - first) / 3.0;
  };
  return {extrapolated(a.filtered_excitation, b.filtered_excitation, c.filtered_excitation),
          extrapolated(a.activation, b.activation, c.activation)};
}

TEST(Activation, StepsOfEveryLawSolveItsDifferentialEquation) {
  std::mt19937_64 random(20061);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const ActivationLaw law : kLaws) {
    if (law == ActivationLaw::envelope) continue;
    const Dynamics d{.law = law};
    for (int k = 0; k < 40; ++k) {
      const double u = share(random);
      const Point from{share(random), share(random)};
      const double interval = 0.002 + 0.05 * share(random);
      const Point exact = step_activation(d, u, from, interval);
      const Point small = by_small_steps(d, u, from, interval, 4000);
      // Extrapolation leaves h^3-terms, (0.05 / 4000 / 0.0075)^3 = 5e-9; a switch inside leaves
      // h^2: (1.25e-5 / 0.015)^2 = 7e-7.
      EXPECT_NEAR(exact.activation, small.activation, 1e-6)
          << static_cast<int>(law) << " u " << u << " from " << from.activation;
      if (state_size(law) == 2) {
        EXPECT_NEAR(exact.filtered_excitation, small.filtered_excitation, 1e-8);
      }
    }
  }
}

TEST(Activation, TwoHalfStepsAreOneStep) {
  // The flow property, to round-off where the step is exact.
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const ActivationLaw law : kLaws) {
    const Dynamics d{.law = law};
    for (int k = 0; k < 200; ++k) {
      const double u = share(random);
      const Point from{share(random), share(random)};
      const double interval = 0.2 * share(random);
      const Point whole = step_activation(d, u, from, interval);
      const Point half = step_activation(d, u, from, 0.37 * interval);
      const Point twice = step_activation(d, u, half, 0.63 * interval);
      const double tolerance = law == ActivationLaw::de_groote ? 1e-7 : 1e-13;
      EXPECT_NEAR(whole.activation, twice.activation, tolerance) << static_cast<int>(law);
    }
  }
}

TEST(Activation, RisesAsTheTwoLagsOfTheClosedForm) {
  // Step of u from 0 to 1: a(t) = 1 - (tau_ne exp(-t/tau_ne) - tau_ac exp(-t/tau_ac)) / (tau_ne -
  // tau_ac), in one step or in many.
  for (const double t : {0.001, 0.05, 0.3}) {
    const double expected = 1.0 - (0.040 * std::exp(-t / 0.040) - 0.015 * std::exp(-t / 0.015)) / 0.025;
    EXPECT_NEAR(step_activation(Dynamics{}, 1.0, {}, t).activation, expected, 1e-15);
  }
}

TEST(Activation, EqualTimesAreTheLimitOfUnequalOnes) {
  const Dynamics equal{.law = ActivationLaw::recursive, .excitation_time_s = 0.03, .activation_time_s = 0.03};
  // 1 - (1 + t / tau) exp(-t / tau)
  EXPECT_NEAR(step_activation(equal, 1.0, {}, 0.06).activation, 1.0 - 3.0 * std::exp(-2.0), 1e-15);
  Dynamics close = equal;
  close.activation_time_s = 0.03 * (1.0 + 1e-9);
  EXPECT_NEAR(step_activation(close, 1.0, {}, 0.06).activation, 1.0 - 3.0 * std::exp(-2.0), 1e-9);
}

TEST(Activation, TimeConstantChangesWhereTheExcitationPassesTheActivation) {
  // e = 1 falls to u = 0 while a = 0.5 still rises: they meet, and a falls with tau_deac from there.
  const Dynamics d;
  const Point from{1.0, 0.5};
  double meeting = 0.0;
  Point before = from;
  for (double t = 1e-5; t < 0.1; t += 1e-5) {
    const Point now = step_activation(d, 0.0, from, t);
    if (now.activation < before.activation) {
      meeting = t;
      break;
    }
    before = now;
  }
  ASSERT_GT(meeting, 0.0);
  const Point met = step_activation(d, 0.0, from, meeting);
  EXPECT_NEAR(met.activation, met.filtered_excitation, 1e-3);  // slope 25/s times the scan's 1e-5 s
  EXPECT_LT(activation_event(d, 0.0, step_activation(d, 0.0, from, meeting + 1e-3)), 0.0);
  EXPECT_GT(activation_event(d, 0.0, step_activation(d, 0.0, from, meeting - 1e-3)), 0.0);
}

TEST(Activation, StaysWithinZeroAndOneAtAnyRate) {
  for (const ActivationLaw law : kLaws) {
    const Dynamics d{.law = law};
    for (const double interval : {1e-4, 1.0 / 30.0, 2.0, 200.0}) {
      Point state;
      for (int k = 0; k < 60; ++k) {
        state = step_activation(d, k % 3 == 0 ? 1.0 : 0.0, state, interval);
        EXPECT_GE(state.activation, 0.0) << static_cast<int>(law);
        EXPECT_LE(state.activation, 1.0) << static_cast<int>(law);
      }
    }
  }
}

TEST(Activation, AConstantExcitationIsTheActivation) {
  for (const ActivationLaw law : kLaws) {
    const Point settled = settled_activation(0.3);
    EXPECT_EQ(settled.activation, 0.3);
    if (state_size(law) == 0) continue;
    const Point rate = activation_rate(Dynamics{.law = law}, 0.3, settled);
    EXPECT_NEAR(rate.activation, 0.0, 1e-13) << static_cast<int>(law);
    EXPECT_NEAR(rate.filtered_excitation, 0.0, 1e-13) << static_cast<int>(law);
  }
}

TEST(Activation, RatesOfTheOtherLawsHaveTheirPublishedTimeConstants) {
  // At a = 1/3 the factor 0.5 + 1.5 a is 1: the nominal constants.
  const auto rate = [](ActivationLaw law, double u, double steepness) {
    const Dynamics d{.law = law, .activation_time_s = 0.015, .deactivation_time_s = 0.060, .steepness = steepness};
    return activation_rate<double>(d, u, {0.0, 1.0 / 3.0}).activation;
  };
  EXPECT_NEAR(rate(ActivationLaw::thelen, 1.0, 1.0), (2.0 / 3.0) / 0.015, 1e-12);
  EXPECT_NEAR(rate(ActivationLaw::thelen, 0.0, 1.0), -(1.0 / 3.0) / 0.060, 1e-12);
  // The smooth law comes to them far from u = a: tanh(100 / 3) is 1 to round-off.
  EXPECT_NEAR(rate(ActivationLaw::de_groote, 1.0, 100.0), (2.0 / 3.0) / 0.015, 1e-10);
  EXPECT_NEAR(rate(ActivationLaw::de_groote, 0.0, 100.0), -(1.0 / 3.0) / 0.060, 1e-10);
}

TEST(Activation, DerivativesByTheTimeConstantsAreExact) {
  using Jet = ceres::Jet<double, 3>;
  for (const ActivationLaw law : kLaws) {
    for (const double u : {0.1, 0.8}) {
      ActivationDynamics<Jet> d{.law = law};
      d.excitation_time_s = Jet(0.04, 0);
      d.activation_time_s = Jet(0.015, 1);
      d.deactivation_time_s = Jet(0.05, 2);
      const ActivationPoint<Jet> r = activation_rate<Jet>(d, Jet(u), {Jet(0.5), Jet(0.4)});
      for (int k = 0; k < 3; ++k) {
        const auto moved = [&](double by) {
          Dynamics n{.law = law};
          (k == 0 ? n.excitation_time_s : k == 1 ? n.activation_time_s : n.deactivation_time_s) *= 1.0 + by;
          return activation_rate<double>(n, u, {0.5, 0.4}).activation;
        };
        const double tau = k == 0 ? 0.04 : k == 1 ? 0.015 : 0.05;
        // A quantity linear in 1/tau: truncation h^2, rounding 1e-16 / h.
        EXPECT_NEAR(r.activation.v[k] * tau, (moved(1e-5) - moved(-1e-5)) / 2e-5, 1e-7);
      }
    }
  }
}

TEST(Activation, RefusesTimesThatAreNotPositive) {
  EXPECT_THROW(validate(Dynamics{.activation_time_s = 0.0}), InvalidInput);
  EXPECT_THROW(validate(Dynamics{.steepness = -1.0}), InvalidInput);
}

}  // namespace
}  // namespace myoid::muscle
