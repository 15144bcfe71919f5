#include "myoid/body/model/body_accelerations.h"

#include <gtest/gtest.h>

#include "tests/support/crooked_tree.h"

namespace myoid::body {
namespace {

using test::crooked_tree;
using test::random_vector;

// Velocities, which other tests check, along q + t qdot + t^2/2 qddot: their central differences
// over 2e-5 s miss by the third derivative (some 1e3) times 1e-10, and by round-off of 1e-11.
void expect_accelerations_are_rates_of_velocities(const BodyModel& m) {
  test::Uniform u(21);
  const Eigen::VectorXd q = random_vector(12, u), qdot = 2.0 * random_vector(12, u), qddot = 5.0 * random_vector(12, u);
  const Vec3 p_BP(0.1, -0.2, 0.3);
  BodyState state = make_state(m);
  compute_poses(m, q, state);
  compute_velocities(m, qdot, state);
  BodyAccelerations acceleration;
  compute_accelerations(m, qddot, state, acceleration);
  const double h = 1e-5;
  const auto at_time = [&](double t) {
    BodyState moved = make_state(m);
    compute_poses(m, q + t * qdot + 0.5 * t * t * qddot, moved);
    compute_velocities(m, qdot + t * qddot, moved);
    return moved;
  };
  const BodyState after = at_time(h), before = at_time(-h);
  const auto speed = [&](const BodyState& s, std::size_t b) {
    return Vec3(s.v_GB[b] + s.w_GB[b].cross(Vec3(s.X_GB[b].R * p_BP)));
  };
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    const Vec3 alpha = (after.w_GB[b] - before.w_GB[b]) / (2.0 * h);
    const Vec3 a = (speed(after, b) - speed(before, b)) / (2.0 * h);
    EXPECT_LT((acceleration.alpha_GB[b] - alpha).norm(), 1e-6) << b;
    EXPECT_LT((acceleration.of_station(state, static_cast<BodyIndex>(b), p_BP).a - a).norm(), 1e-6) << b;
  }
}

TEST(BodyAccelerations, AreTheRatesOfTheVelocities) { expect_accelerations_are_rates_of_velocities(crooked_tree(1)); }

TEST(BodyAccelerations, AreSoWhereAxesShareCoordinates) {
  expect_accelerations_are_rates_of_velocities(crooked_tree(1, true));
}

TEST(BodyAccelerations, AreSoAtBentRodsAndOnEllipsoids) {
  expect_accelerations_are_rates_of_velocities(crooked_tree(1, false, true));
}

TEST(BodyAccelerations, CountFromTheAccelerationOfTheGround) {
  const BodyModel m = crooked_tree(2);
  test::Uniform u(3);
  BodyState state = make_state(m);
  compute_poses(m, random_vector(12, u), state);
  compute_velocities(m, random_vector(12, u), state);
  const Eigen::VectorXd qddot = random_vector(12, u);
  BodyAccelerations still, lifted;
  compute_accelerations(m, qddot, state, still);
  compute_accelerations(m, qddot, state, lifted, Vec3(1.0, 2.0, 3.0));
  for (std::size_t b = 0; b < m.bodies.size(); ++b)
    EXPECT_LT((lifted.a_GB[b] - still.a_GB[b] - Vec3(1.0, 2.0, 3.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace myoid::body
