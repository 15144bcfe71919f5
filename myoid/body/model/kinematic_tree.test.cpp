#include "myoid/body/model/kinematic_tree.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/crooked_tree.h"

namespace myoid::body {
namespace {

using test::crooked_tree;
using test::random_vector;
using test::Uniform;

void expect_jacobian_is_derivative(const BodyModel& m) {
  Uniform u(2);
  const Eigen::VectorXd q = random_vector(12, u);
  const Vec3 p_BP(0.1, -0.2, 0.3);
  BodyState state = make_state(m);
  compute_poses(m, q, state);
  const Eigen::Matrix3Xd jacobian = station_jacobian(m, state, 3, p_BP);
  const double h = 1e-6;
  for (Eigen::Index k = 0; k < 12; ++k) {
    BodyState plus = make_state(m);
    BodyState minus = make_state(m);
    compute_poses(m, q + h * Eigen::VectorXd::Unit(12, k), plus);
    compute_poses(m, q - h * Eigen::VectorXd::Unit(12, k), minus);
    const Vec3 difference = (plus.X_GB[3] * p_BP - minus.X_GB[3] * p_BP) / (2.0 * h);
    EXPECT_LT((jacobian.col(k) - difference).norm(), 1e-8) << k;  // truncation h^2, round-off eps/h
  }
}

TEST(KinematicTree, StationJacobianIsTheDerivativeOfThePosition) { expect_jacobian_is_derivative(crooked_tree(1)); }

TEST(KinematicTree, SoItIsAtBentRodsAndOnEllipsoids) { expect_jacobian_is_derivative(crooked_tree(1, false, true)); }

TEST(KinematicTree, VelocitiesAreTheJacobianTimesTheRates) {
  const BodyModel m = crooked_tree(3);
  Uniform u(4);
  const Eigen::VectorXd q = random_vector(12, u);
  const Eigen::VectorXd qdot = random_vector(12, u);
  BodyState state = make_state(m);
  compute_poses(m, q, state);
  compute_velocities(m, qdot, state);
  const Vec3 p_BP(0.1, -0.2, 0.3);
  for (int b = 1; b <= 4; ++b) {
    const Vec3 v = state.v_GB[static_cast<std::size_t>(b)] +
                   state.w_GB[static_cast<std::size_t>(b)].cross(state.X_GB[static_cast<std::size_t>(b)].R * p_BP);
    EXPECT_LT((station_jacobian(m, state, b, p_BP) * qdot - v).norm(), 1e-13);
  }
}

/// Kinetic plus potential energy.
double energy(const BodyModel& m, const Eigen::VectorXd& q, const Eigen::VectorXd& qdot) {
  BodyState state = make_state(m);
  compute_poses(m, q, state);
  compute_velocities(m, qdot, state);
  double sum = 0.0;
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    const Body& body = m.bodies[b];
    const Vec3 c = state.X_GB[b].R * body.p_BBcm_B;
    const Vec3 v = state.v_GB[b] + state.w_GB[b].cross(c);
    const Vec3 w_B = state.X_GB[b].R.transpose() * state.w_GB[b];
    sum += 0.5 * body.mass_kg * v.squaredNorm() + 0.5 * w_B.dot(body.I_BBcm_B * w_B) -
           body.mass_kg * m.gravity_G.dot(state.X_GB[b].p + c);
  }
  return sum;
}

TEST(InverseDynamics, TheForcesWorkIsTheChangeOfEnergy) {
  const BodyModel m = crooked_tree(5);
  Uniform u(6);
  const Eigen::VectorXd q = 0.5 * random_vector(12, u);
  const Eigen::VectorXd qdot = random_vector(12, u);
  const Eigen::VectorXd qddot = random_vector(12, u);
  BodyState state = make_state(m);
  const Eigen::VectorXd tau = inverse_dynamics(m, q, qdot, qddot, {}, state);
  const double h = 1e-5;
  const auto at = [&](double t) { return energy(m, q + t * qdot + 0.5 * t * t * qddot, qdot + t * qddot); };
  const double power = (at(h) - at(-h)) / (2.0 * h);
  EXPECT_NEAR(tau.dot(qdot), power, 1e-7 * std::max(1.0, std::abs(power)));
}

void expect_lagranges_equations(const BodyModel& m) {
  // tau_k = d/dt dL/dqdot_k - dL/dq_k, all by differences of the energy function: independent of Newton-Euler.
  Uniform u(8);
  const Eigen::VectorXd q = 0.5 * random_vector(12, u);
  const Eigen::VectorXd qdot = random_vector(12, u);
  const Eigen::VectorXd qddot = random_vector(12, u);
  BodyState state = make_state(m);
  const Eigen::VectorXd tau = inverse_dynamics(m, q, qdot, qddot, {}, state);
  BodyModel weightless = m;
  weightless.gravity_G.setZero();
  const auto kinetic = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& v) { return energy(weightless, x, v); };
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(12);
  const auto potential = [&](const Eigen::VectorXd& x) { return energy(m, x, zero); };
  const double h = 1e-3;
  for (Eigen::Index k = 0; k < 12; ++k) {
    const Eigen::VectorXd e = Eigen::VectorXd::Unit(12, k);
    // T is quadratic in qdot: its central difference is exact for any step.
    const auto momentum = [&](double t) {
      const Eigen::VectorXd x = q + t * qdot + 0.5 * t * t * qddot;
      const Eigen::VectorXd v = qdot + t * qddot;
      return 0.5 * (kinetic(x, v + e) - kinetic(x, v - e));
    };
    const auto richardson = [&](auto f) {
      const double wide = (f(h) - f(-h)) / (2.0 * h);
      const double narrow = (f(0.5 * h) - f(-0.5 * h)) / h;
      return (4.0 * narrow - wide) / 3.0;  // error h^4
    };
    const double expected =
        richardson(momentum) - richardson([&](double t) { return kinetic(q + t * e, qdot) - potential(q + t * e); });
    EXPECT_NEAR(tau[k], expected, 1e-7 * std::max(1.0, std::abs(expected))) << k;
  }
}

TEST(InverseDynamics, LagrangesEquationsGiveTheSameForces) { expect_lagranges_equations(crooked_tree(7)); }

TEST(InverseDynamics, LagrangesEquationsHoldWhereRotationsShareACoordinate) {
  expect_lagranges_equations(crooked_tree(7, true));
}

TEST(InverseDynamics, LagrangesEquationsHoldAtBentRodsAndOnEllipsoids) {
  expect_lagranges_equations(crooked_tree(7, false, true));
}

TEST(MassMatrix, IsSymmetricPositiveAndTheKineticEnergysForm) {
  const BodyModel m = crooked_tree(9);
  Uniform u(10);
  const Eigen::VectorXd q = random_vector(12, u);
  const Eigen::VectorXd qdot = random_vector(12, u);
  BodyState state = make_state(m);
  const Eigen::MatrixXd mass = mass_matrix(m, q, state);
  EXPECT_LT((mass - mass.transpose()).norm(), 1e-12 * mass.norm());
  BodyModel weightless = m;
  weightless.gravity_G.setZero();
  EXPECT_NEAR(0.5 * qdot.dot(mass * qdot), energy(weightless, q, qdot), 1e-12 * mass.norm());
}

TEST(InverseDynamics, AnExternalWrenchActsThroughItsJacobian) {
  const BodyModel m = crooked_tree(11);
  Uniform u(12);
  const Eigen::VectorXd q = random_vector(12, u);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(12);
  BodyState state = make_state(m);
  const Vec3 f(3.0, -2.0, 5.0);
  const Eigen::VectorXd with = inverse_dynamics(m, q, rest, rest, {{.body = 3, .f_G = f}}, state);
  const Eigen::VectorXd without = inverse_dynamics(m, q, rest, rest, {}, state);
  EXPECT_LT((without - with - station_jacobian(m, state, 3, Vec3::Zero()).transpose() * f).norm(), 1e-12);
}

TEST(Finalize, RefusesABodyThatHangsOnNothing) {
  BodyModel m;
  m.bodies = {{.name = "ground"}, {.name = "lost"}};
  EXPECT_THROW((void)finalize(m), ModelError);
}

}  // namespace
}  // namespace myoid::body
