#include "myoid/ground/math/runge_kutta.h"

#include <array>
#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/ode_events.h"

namespace myoid::inline ground::math {
namespace {

/// An oscillator of 1 rad/s from (1, 0): y = (cos t, -sin t).
constexpr auto kOscillator = [](double, const double* y, double* ydot) {
  ydot[0] = y[1];
  ydot[1] = -y[0];
};
constexpr std::array kBegin{1.0, 0.0};

/// Error of cos(t) after `steps` equal steps over ten seconds.
double error_after(int steps) {
  OdeOptions options;
  options.relative_tolerance = options.absolute_tolerance = 1.0;  // never rejects
  options.max_step_s = options.first_step_s = 10.0 / steps;
  RungeKutta<double> solver(2, options);
  EXPECT_EQ(solver.start(0.0, std::span<const double>(kBegin), kOscillator), OdeStatus::done);
  for (int k = 1; k <= steps; ++k) EXPECT_EQ(solver.step(10.0 * k / steps, kOscillator), OdeStatus::done);
  return std::hypot(solver.state()[0] - std::cos(10.0), solver.state()[1] + std::sin(10.0));
}

TEST(RungeKutta, HalfTheStepIsAThirtySecondOfTheError) {
  // Order 5. The next term of the error is one step size (a twentieth and less) smaller.
  const double ratio = error_after(200) / error_after(400);
  EXPECT_NEAR(ratio, 32.0, 32.0 * 0.1);
}

TEST(RungeKutta, ATighterToleranceReducesTheErrorInProportion) {
  double before = 0.0;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    RungeKutta<double> solver(2, {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
    ASSERT_EQ(solver.start(0.0, std::span<const double>(kBegin), kOscillator), OdeStatus::done);
    while (solver.time_s() < 10.0) {
      ASSERT_EQ(solver.step(10.0, kOscillator), OdeStatus::done);
    }
    const double error = std::abs(solver.state()[0] - std::cos(10.0));
    EXPECT_LT(error, 20.0 * tolerance);
    // The error per step is kept at the tolerance: a hundredth of it, within a factor of four.
    if (before > 0.0) {
      EXPECT_NEAR(std::log10(before / error), 2.0, 0.6);
    }
    before = error;
  }
}

TEST(RungeKutta, TheInterpolantIsAsGoodAsTheStepsAndItsPolynomialIsTheSame) {
  RungeKutta<double> solver(2, {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-9});
  ASSERT_EQ(solver.start(0.0, std::span<const double>(kBegin), kOscillator), OdeStatus::done);
  while (solver.time_s() < 5.0) {
    ASSERT_EQ(solver.step(5.0, kOscillator), OdeStatus::done);
    for (const double share : {0.0, 0.3, 0.5, 0.9, 1.0}) {
      const double s = share * (solver.time_s() - solver.previous_time_s());
      const double t = solver.previous_time_s() + s;
      std::array<double, 2> y{};
      solver.interpolate(t, y);
      EXPECT_NEAR(y[0], std::cos(t), 3e-8);  // one order less than the steps
      const auto c = solver.polynomial(0);
      EXPECT_NEAR(c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * c[4]))), y[0], 1e-14);
    }
  }
}

TEST(RungeKutta, DualsThroughTheStepsAreTheDerivativesOfTheSolution) {
  using Jet = ceres::Jet<double, 2>;
  // dy/dt = -k y from y0: y = y0 exp(-k t), dy/dk = -t y, dy/dy0 = exp(-k t).
  const Jet k(0.7, 0);
  const auto rate = [&](double, const Jet* y, Jet* ydot) { ydot[0] = -k * y[0]; };
  RungeKutta<Jet> solver(1, {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12});
  const std::array<Jet, 1> begin{Jet(3.0, 1)};
  ASSERT_EQ(solver.start(0.0, std::span<const Jet>(begin), rate), OdeStatus::done);
  while (solver.time_s() < 2.0) {
    ASSERT_EQ(solver.step(2.0, rate), OdeStatus::done);
  }
  const double exact = 3.0 * std::exp(-1.4);
  EXPECT_NEAR(solver.state()[0].a, exact, 1e-9);
  EXPECT_NEAR(solver.state()[0].v[0], -2.0 * exact, 1e-8);
  EXPECT_NEAR(solver.state()[0].v[1], exact / 3.0, 1e-8);
}

// y' = |y - t| type kinks: here a velocity that changes its sign, and with it the law.
TEST(RungeKutta, StepsEndAtAKink) {
  // y' = cos t while cos t >= 0, else 3 cos t: y = sin t up to pi/2, then 1 + 3 (sin t - 1).
  const auto rate = [](double t, const double* /*y*/, double* ydot) {
    ydot[0] = std::cos(t) >= 0.0 ? std::cos(t) : 3.0 * std::cos(t);
  };
  const auto events = [](double t, const double* /*y*/, double* g) { g[0] = std::cos(t); };
  RungeKutta<double> solver(1, {.relative_tolerance = 1e-6, .absolute_tolerance = 1e-6});
  const std::array begin{0.0};
  ASSERT_EQ(solver.start(0.0, std::span<const double>(begin), rate), OdeStatus::done);
  EventSigns signs(1);
  signs.start(std::array{1.0});
  double nearest = 1.0;
  const auto on_step = [&](const auto& s) {
    nearest = std::min(nearest, std::abs(s.time_s() - 0.5 * kPi));
    return true;
  };
  ASSERT_EQ(integrate(solver, 3.0, signs, events, on_step, rate), OdeStatus::done);
  EXPECT_LT(nearest, 1e-9);
  EXPECT_EQ(solver.statistics().events, 1);
  EXPECT_NEAR(solver.state()[0], 1.0 + 3.0 * (std::sin(3.0) - 1.0), 1e-5);
}

TEST(RungeKutta, SaysWhyItDoesNotGoOn) {
  const auto blows_up = [](double, const double* y, double* ydot) { ydot[0] = y[0] * y[0]; };
  const std::array begin{1.0};  // y = 1 / (1 - t)
  RungeKutta<double> solver(1, {});
  ASSERT_EQ(solver.start(0.0, std::span<const double>(begin), blows_up), OdeStatus::done);
  OdeStatus status = OdeStatus::done;
  while (status == OdeStatus::done && solver.time_s() < 2.0) status = solver.step(2.0, blows_up);
  EXPECT_NE(status, OdeStatus::done);
  EXPECT_NEAR(solver.time_s(), 1.0, 1e-6);

  RungeKutta<double> short_of_steps(2, {.max_steps = 3});
  ASSERT_EQ(short_of_steps.start(0.0, std::span<const double>(kBegin), kOscillator), OdeStatus::done);
  status = OdeStatus::done;
  while (status == OdeStatus::done) status = short_of_steps.step(10.0, kOscillator);
  EXPECT_EQ(status, OdeStatus::too_many_steps);
  EXPECT_THROW(RungeKutta<double>(1, {.relative_tolerance = -1.0}), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
