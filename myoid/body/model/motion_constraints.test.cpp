#include "myoid/body/model/motion_constraints.h"

#include <gtest/gtest.h>

#include "myoid/body/model/constraints.h"

#include "tests/support/crooked_tree.h"

namespace myoid::body {
namespace {

using test::crooked_tree;
using test::random_vector;

/// A crooked tree with one constraint of every kind between random places, a coupler and a locked
/// coordinate; nothing of it is met.
BodyModel bound_tree() {
  BodyModel m = crooked_tree(4);
  test::Uniform u(5);
  const auto frame = [&] { return Pose{rotation_body_xyz(u.vec()), 0.3 * u.vec()}; };
  m.couplers.push_back(
      {.name = "coupler", .dependent = 2, .independent = 1, .function = Polynomial{{0.3, -0.5, 0.2, 0.1}}});
  m.constraints.push_back({"ball", "PointConstraint", FrameConstraint{2, 4, frame(), frame()}});
  m.constraints.push_back({"weld", "WeldConstraint", FrameConstraint{0, 3, frame(), frame(), true}});
  m.constraints.push_back({"rod", "ConstantDistanceConstraint", DistanceConstraint{1, 3, u.vec(), u.vec(), 0.5}});
  m.constraints.push_back(
      {"line", "PointOnLineConstraint", LineConstraint{4, 3, u.vec().normalized(), u.vec(), u.vec()}});
  m.coordinates[7].locked = true;
  return finalize(m);
}

// Along any motion the rate of A qdot is A qddot - b. Differences over 2e-5 s: as in body_accelerations.test.cpp.
TEST(MotionConstraints, AreTheRatesOfTheConstraintsOnSpeeds) {
  const BodyModel m = bound_tree();
  test::Uniform u(6);
  const Eigen::VectorXd q = random_vector(12, u), qdot = random_vector(12, u), qddot = random_vector(12, u);
  const auto speeds = [&](double t) {
    BodyState state = make_state(m);
    compute_poses(m, q + t * qdot + 0.5 * t * t * qddot, state);
    return Eigen::VectorXd(constraint_jacobian(m, state) * (qdot + t * qddot));
  };
  BodyState state = make_state(m);
  compute_poses(m, q, state);
  compute_velocities(m, qdot, state);
  const AccelerationConstraints rows = acceleration_constraints(m, state, 0.0);
  const double h = 1e-5;
  const Eigen::VectorXd rate = (speeds(h) - speeds(-h)) / (2.0 * h);
  ASSERT_EQ(rows.A.rows(), rate.size() + 1);
  EXPECT_LT(((rows.A * qddot - rows.b).head(rate.size()) - rate).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(rows.A.bottomRows<1>(), Eigen::RowVectorXd::Unit(12, 7));
  EXPECT_EQ(rows.b[rows.b.size() - 1], 0.0);
}

// Virtual work: at any speeds the wrenches have the power of the multipliers on their rows.
TEST(MotionConstraints, WrenchesDoTheWorkOfTheirMultipliers) {
  const BodyModel m = bound_tree();
  test::Uniform u(8);
  BodyState state = make_state(m);
  compute_poses(m, random_vector(12, u), state);
  const Eigen::VectorXd qdot = random_vector(12, u);
  compute_velocities(m, qdot, state);
  const AccelerationConstraints rows = acceleration_constraints(m, state, 0.0);
  Eigen::VectorXd multipliers = random_vector(rows.A.rows(), u);
  multipliers[0] = 0.0;                       // the coupler
  multipliers[multipliers.size() - 1] = 0.0;  // the lock
  std::vector<BodyWrench> wrenches;
  append_constraint_wrenches(m, state, multipliers, wrenches);
  double power_w = 0.0;
  for (const BodyWrench& w : wrenches) {
    const auto b = static_cast<std::size_t>(w.body);
    power_w += w.f_G.dot(state.v_GB[b]) + w.m_G.dot(state.w_GB[b]);
  }
  EXPECT_NEAR(power_w, multipliers.dot(rows.A * qdot), 1e-12 * (1.0 + std::abs(power_w)) * 10.0);
}

// A polynomial of coordinates, q3 = q0 q1 + 2 q1^2: second derivative 2 u0 u1 + 4 u1^2.
TEST(MotionConstraints, PolynomialsOfCoordinatesHaveTheirCurvature) {
  BodyModel m = crooked_tree(4);
  FunctionConstraint law{.dependent = 3, .independent = {0, 1}};
  law.function = {.dimension = 2, .degree = 2, .coefficients = {0.0, 0.0, 2.0, 0.0, 1.0, 0.0}};
  m.constraints.push_back({"f", "CoordinateCouplerConstraint", law});
  m = finalize(m);
  test::Uniform u(9);
  BodyState state = make_state(m);
  compute_poses(m, random_vector(12, u), state);
  const Eigen::VectorXd qdot = random_vector(12, u);
  compute_velocities(m, qdot, state);
  const AccelerationConstraints rows = acceleration_constraints(m, state, 0.0);
  EXPECT_NEAR(rows.b[0], 2.0 * qdot[0] * qdot[1] + 4.0 * qdot[1] * qdot[1], 1e-9);
}

TEST(MotionConstraints, PrescribedCoordinatesFollowTheirFunction) {
  BodyModel m = crooked_tree(4);
  m.coordinates[5].prescribed = Polynomial{{3.0, 1.0, 0.0, 0.0}};
  BodyState state = make_state(m);
  compute_poses(m, Eigen::VectorXd::Zero(12), state);
  compute_velocities(m, Eigen::VectorXd::Zero(12), state);
  const AccelerationConstraints rows = acceleration_constraints(m, state, 0.5);
  ASSERT_EQ(rows.b.size(), 1);
  EXPECT_NEAR(rows.b[0], 18.0 * 0.5 + 2.0, 1e-12);
}

}  // namespace
}  // namespace myoid::body
