#include "myoid/ground/math/stiff_ode.h"

#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/ode_events.h"

namespace myoid::inline ground::math {
namespace {

/// Robertson's three reactions, rates from 0.04 to 3e7 1/s: the classic stiff problem.
StiffProblem robertson() {
  StiffProblem p;
  p.state_count = 3;
  p.rate = [](double, const double* y, double* d) {
    d[0] = -0.04 * y[0] + 1e4 * y[1] * y[2];
    d[2] = 3e7 * y[1] * y[1];
    d[1] = -d[0] - d[2];
    return true;
  };
  return p;
}

OdeStatus run(StiffIntegrator& solver, double end_s) {
  EventSigns none(0);
  const auto no_events = [](double, const double*, double*) {};
  const auto on_step = [](const StiffIntegrator&) { return true; };
  return integrate(solver, end_s, none, no_events, on_step);
}

TEST(StiffIntegrator, SolvesRobertsonsReactions) {
  StiffIntegrator solver(robertson(), {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-14});
  solver.start(0.0, std::array{1.0, 0.0, 0.0});
  ASSERT_EQ(run(solver, 40.0), OdeStatus::done);
  // Published solution at t = 40 (Hairer & Wanner, Solving ODEs II), to its last digit given.
  EXPECT_NEAR(solver.state()[0], 0.7158270688, 1e-8);
  EXPECT_NEAR(solver.state()[1], 0.9185534764e-5, 1e-13);
  EXPECT_NEAR(solver.state()[2], 0.2841637457, 1e-8);
  EXPECT_LT(solver.statistics().steps, 3000);  // an explicit method would need 1e5
}

TEST(StiffIntegrator, TheJacobianGivenAndThatByDifferencesLeadToTheSame) {
  StiffProblem problem = robertson();
  problem.jacobian = [](double, const double* y, double* j) {
    j[0] = -0.04, j[3] = 1e4 * y[2], j[6] = 1e4 * y[1];
    j[2] = 0.0, j[5] = 6e7 * y[1], j[8] = 0.0;
    for (int c = 0; c < 3; ++c) j[3 * c + 1] = -j[3 * c] - j[3 * c + 2];
  };
  StiffIntegrator solver(std::move(problem), {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-14});
  solver.start(0.0, std::array{1.0, 0.0, 0.0});
  ASSERT_EQ(run(solver, 40.0), OdeStatus::done);
  EXPECT_NEAR(solver.state()[0], 0.7158270688, 1e-8);
}

/// y' = -k (y - cos t) - sin t, stiff with k = 1e4 and solved by cos t; z' = y.
TEST(StiffIntegrator, IntegratesAlongAndInterpolates) {
  StiffProblem p;
  p.state_count = 1;
  p.rate = [](double t, const double* y, double* d) {
    d[0] = -1e4 * (y[0] - std::cos(t)) - std::sin(t);
    return true;
  };
  p.quadrature_count = 1;
  p.quadrature = [](double, const double* y, double* d) {
    d[0] = y[0];
    return true;
  };
  StiffIntegrator solver(std::move(p), {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-11});
  solver.start(0.0, std::array{1.0});
  EventSigns none(0);
  const auto no_events = [](double, const double*, double*) {};
  const auto on_step = [](const StiffIntegrator& s) {
    const double t = 0.5 * (s.previous_time_s() + s.time_s());
    std::array<double, 1> y{};
    std::array<double, 1> z{};
    s.interpolate(t, y);
    s.interpolate_quadrature(t, z);
    EXPECT_NEAR(y[0], std::cos(t), 1e-7);
    EXPECT_NEAR(z[0], std::sin(t), 1e-7);
    return true;
  };
  ASSERT_EQ(integrate(solver, 3.0, none, no_events, on_step), OdeStatus::done);
}

TEST(StiffIntegrator, SensitivitiesAreTheDerivativesOfTheSolution) {
  // y' = -k y from y0: by k and by y0.
  StiffProblem p;
  p.state_count = 1;
  p.rate = [](double, const double* y, double* d) {
    d[0] = -0.7 * y[0];
    return true;
  };
  p.sensitivity_count = 2;
  p.sensitivity = [](double, const double* y, const double* const* s, double* const* d) {
    d[0][0] = -0.7 * s[0][0] - y[0];
    d[1][0] = -0.7 * s[1][0];
    return true;
  };
  StiffIntegrator solver(std::move(p), {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12});
  solver.start(0.0, std::array{3.0}, std::array{0.0, 1.0});
  ASSERT_EQ(run(solver, 1.0), OdeStatus::done);
  solver.renew();  // restarting in the middle loses nothing
  ASSERT_EQ(run(solver, 2.0), OdeStatus::done);
  std::array<double, 2> s{};
  solver.interpolate_sensitivity(2.0, s);
  EXPECT_NEAR(s[0], -2.0 * 3.0 * std::exp(-1.4), 1e-7);
  EXPECT_NEAR(s[1], std::exp(-1.4), 1e-7);
}

TEST(StiffIntegrator, PassesAJumpThatNobodyAnnounced) {
  StiffProblem p;
  p.state_count = 1;
  p.quadrature_count = 1;
  p.rate = [](double t, const double*, double* d) {
    d[0] = t < 0.3 ? 1.0 : 1e9;
    return true;
  };
  p.quadrature = [](double, const double*, double* d) {
    d[0] = 2.0;
    return true;
  };
  StiffIntegrator solver(std::move(p), {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-14});
  solver.start(0.0, std::array{0.0});
  ASSERT_EQ(run(solver, 1.0), OdeStatus::step_too_small);
  EXPECT_NEAR(solver.time_s(), 0.3, 1e-9);
  int hops = 0;
  OdeStatus status = OdeStatus::step_too_small;
  while (status == OdeStatus::step_too_small && hops < 5) {
    ++hops;
    ASSERT_EQ(solver.hop(1e-9), OdeStatus::done);
    status = run(solver, 1.0);
  }
  ASSERT_EQ(status, OdeStatus::done);
  EXPECT_LE(hops, 2);
  // A nanosecond or two at 1 instead of 1e9.
  EXPECT_NEAR(solver.state()[0], 0.3 + 0.7e9, 2.5);
  std::array<double, 1> z{};
  solver.interpolate_quadrature(1.0, z);
  EXPECT_NEAR(z[0], 2.0, 1e-12);
}

TEST(StiffIntegrator, SaysWhyItDoesNotGoOn) {
  StiffProblem p;
  p.state_count = 1;
  p.rate = [](double t, const double*, double* d) {
    d[0] = 1.0;
    return t < 0.5;
  };
  StiffIntegrator solver(std::move(p), {});
  solver.start(0.0, std::array{0.0});
  EXPECT_EQ(run(solver, 1.0), OdeStatus::rate_failed);
  EXPECT_NEAR(solver.time_s(), 0.5, 1e-3);

  StiffIntegrator few(robertson(), {.max_steps = 5});
  few.start(0.0, std::array{1.0, 0.0, 0.0});
  EXPECT_EQ(run(few, 40.0), OdeStatus::too_many_steps);
  EXPECT_THROW(StiffIntegrator(robertson(), {.absolute_tolerances = {1.0}}), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
