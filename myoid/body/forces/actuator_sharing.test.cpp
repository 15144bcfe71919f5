#include "myoid/body/forces/actuator_sharing.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"

namespace myoid::body {
namespace {

const double kInfinity = std::numeric_limits<double>::infinity();

TEST(ActuatorSharing, TwoActuatorsShareByTheLawOfLagrange) {
  // x ~ a^(1/(p-1)); for p = 3: x_i = sqrt(lambda a_i / 3).
  ActuatorProblem problem{Eigen::RowVector2d(10.0, 40.0), Eigen::VectorXd::Constant(1, 20.0), Eigen::Vector2d::Zero(),
                          Eigen::Vector2d::Ones(), 3.0};
  const ActuatorSolution s = solve_actuators(problem);
  ASSERT_TRUE(s.solved);
  EXPECT_NEAR(s.control[1] / s.control[0], 2.0, 1e-9);
  EXPECT_NEAR(10.0 * s.control[0] + 40.0 * s.control[1], 20.0, 1e-11);
}

TEST(ActuatorSharing, LargeExponentsShareByTheLawOfLagrangeToo) {
  for (const double p : {8.0, 20.0, 50.0, 100.0}) {
    // Two joints; the second needs a hundredth of the first's effort.
    ActuatorProblem problem{Eigen::MatrixXd::Zero(2, 4), Eigen::Vector2d(20.0, 0.2), Eigen::VectorXd::Constant(4, 1e-4),
                            Eigen::VectorXd::Ones(4), p};
    problem.forces.row(0) << 10.0, 40.0, 0.0, 0.0;
    problem.forces.row(1) << 0.0, 0.0, 10.0, 40.0;
    const ActuatorSolution s = solve_actuators(problem);
    EXPECT_TRUE(s.solved) << p << " " << s.kkt_residual;
    EXPECT_TRUE(s.feasible) << p;
    // x_i ~ a_i^(1/(p-1)), and the sum of a_i x_i is the torque.
    const double ratio = std::pow(4.0, 1.0 / (p - 1.0));
    EXPECT_NEAR(s.control[0], 20.0 / (10.0 + 40.0 * ratio), 1e-9) << p;
    EXPECT_NEAR(s.control[1], ratio * s.control[0], 1e-9) << p;
    EXPECT_NEAR(10.0 * s.control[2] + 40.0 * s.control[3], 0.2, 1e-12) << p;
  }
}

TEST(ActuatorSharing, NoExponentMakesAPossibleTorqueImpossible) {
  math::Random random(11, 1);
  for (const double p : {2.5, 6.0, 15.0, 40.0, 100.0}) {
    for (int trial = 0; trial < 10; ++trial) {
      const Eigen::Index m = 2 + trial % 5, n = m + 6;
      ActuatorProblem problem{Eigen::MatrixXd(m, n), Eigen::VectorXd(m), Eigen::VectorXd::Constant(n, 0.01),
                              Eigen::VectorXd::Ones(n), p};
      for (Eigen::Index k = 0; k < m; ++k)
        for (Eigen::Index i = 0; i < n; ++i) problem.forces(k, i) = 30.0 * random.normal();
      Eigen::VectorXd inside(n);
      for (Eigen::Index i = 0; i < n; ++i) inside[i] = 0.05 + 0.9 * random.uniform();
      problem.required = problem.forces * inside;
      const ActuatorSolution s = solve_actuators(problem);
      EXPECT_TRUE(s.feasible) << p << " " << trial;
      // Beyond exponents of 15 the cost of a control at half of the greatest lies below rounding.
      EXPECT_LT(s.kkt_residual, p <= 15.0 ? 1e-9 : 1e-5) << p << " " << trial;
      EXPECT_NEAR((problem.required - problem.forces * s.control).cwiseAbs().maxCoeff(), 0.0, 1e-9) << p;
      const auto cost = [&](const Eigen::VectorXd& x) { return x.cwiseAbs().array().pow(p).sum(); };
      EXPECT_LE(cost(s.control), cost(inside) * (1.0 + 1e-9)) << p << " " << trial;
    }
  }
}

TEST(ActuatorSharing, BoundsHoldAndTheRestMakesUpForThem) {
  ActuatorProblem problem{Eigen::RowVector3d(100.0, 10.0, 1.0), Eigen::VectorXd::Constant(1, 106.0),
                          Eigen::Vector3d(0.01, 0.01, -kInfinity), Eigen::Vector3d(1.0, 0.5, kInfinity), 2.0};
  const ActuatorSolution s = solve_actuators(problem);
  ASSERT_TRUE(s.solved);
  EXPECT_DOUBLE_EQ(s.control[0], 1.0);
  EXPECT_DOUBLE_EQ(s.control[1], 0.5);
  EXPECT_NEAR(s.control[2], 1.0, 1e-12);
}

TEST(ActuatorSharing, RandomProblemsAreOptimalAgainstEveryFeasibleNeighbour) {
  math::Random random(7, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const Eigen::Index m = 2 + trial % 5, n = m + 6;
    ActuatorProblem problem{Eigen::MatrixXd(m, n), Eigen::VectorXd(m), Eigen::VectorXd::Constant(n, 0.01),
                            Eigen::VectorXd::Ones(n), trial % 3 == 0 ? 3.0 : 2.0};
    for (Eigen::Index k = 0; k < m; ++k)
      for (Eigen::Index i = 0; i < n; ++i) problem.forces(k, i) = 30.0 * random.normal();
    Eigen::VectorXd inside(n);
    for (Eigen::Index i = 0; i < n; ++i) inside[i] = 0.05 + 0.9 * random.uniform();
    problem.required = problem.forces * inside;
    const ActuatorSolution s = solve_actuators(problem);
    ASSERT_TRUE(s.solved) << trial << " " << s.kkt_residual;
    const auto cost = [&](const Eigen::VectorXd& x) { return x.cwiseAbs().array().pow(problem.exponent).sum(); };
    // The problem is convex: no point on the way to a feasible one may be cheaper.
    for (const double share : {1e-3, 0.1, 1.0})
      EXPECT_GE(cost(s.control + share * (inside - s.control)), cost(s.control) - 1e-12);
  }
}

TEST(ActuatorSharing, WhatCannotBeMadeIsSaidNotHidden) {
  ActuatorProblem problem{Eigen::RowVector2d(10.0, 10.0), Eigen::VectorXd::Constant(1, 50.0), Eigen::Vector2d::Zero(),
                          Eigen::Vector2d::Ones(), 2.0};
  const ActuatorSolution s = solve_actuators(problem);
  EXPECT_FALSE(s.feasible);
  EXPECT_FALSE(s.solved);
  EXPECT_NEAR(s.control.minCoeff(), 1.0, 1e-12);  // both at their bounds
}

TEST(ActuatorSharing, RefusesAnExponentThatMakesNoStrictOptimum) {
  ActuatorProblem problem{Eigen::RowVector2d(1.0, 1.0), Eigen::VectorXd::Ones(1), Eigen::Vector2d::Zero(),
                          Eigen::Vector2d::Ones(), 1.0};
  EXPECT_THROW((void)solve_actuators(problem), InvalidInput);
}

}  // namespace
}  // namespace myoid::body
