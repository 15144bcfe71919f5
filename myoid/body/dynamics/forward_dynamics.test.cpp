#include "myoid/body/dynamics/forward_dynamics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/crooked_tree.h"

namespace myoid::body {
namespace {

// The recursive Newton-Euler method, which other tests check against Lagrange's equations, says
// which forces an acceleration takes; they make that acceleration.
TEST(ForwardDynamics, UndoesInverseDynamics) {
  const body::BodyModel m = test::crooked_tree(3);
  test::Uniform u(7);
  const Eigen::VectorXd q = test::random_vector(12, u), qdot = 3.0 * test::random_vector(12, u),
                        qddot = 20.0 * test::random_vector(12, u);
  const std::vector<body::BodyWrench> wrenches{{3, u.vec(), u.vec()}};
  body::BodyState state = body::make_state(m);
  const Eigen::VectorXd tau = body::inverse_dynamics(m, q, qdot, qddot, wrenches, state);
  ForwardDynamics dynamics(m);
  dynamics.set(q, qdot, 0.0);
  const auto solution = dynamics.solve(tau, wrenches);
  // Round-off of forces (1e-14 of some 1e2) over the least eigenvalue of the mass matrix, 1e-4.
  EXPECT_LT((solution.qddot - qddot).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(solution.multipliers.size(), 0);
}

// Both equations, put together from other functions: what the motion takes is what acts and what
// the constraints add, and the constraints stay met.
TEST(ForwardDynamics, SolvesTheEquationsOfMotionWithConstraints) {
  body::BodyModel m = test::crooked_tree(3);
  test::Uniform u(9);
  m.couplers.push_back(
      {.name = "coupler", .dependent = 2, .independent = 1, .function = body::Polynomial{{0.3, -0.5, 0.2, 0.1}}});
  m.constraints.push_back({"rod", "ConstantDistanceConstraint", body::DistanceConstraint{1, 3, u.vec(), u.vec(), 0.5}});
  m.constraints.push_back(
      {"line", "PointOnLineConstraint", body::LineConstraint{4, 3, u.vec().normalized(), u.vec(), u.vec()}});
  m.coordinates[7].locked = true;
  m = body::finalize(m);
  const Eigen::VectorXd q = test::random_vector(12, u), qdot = 3.0 * test::random_vector(12, u),
                        tau = 10.0 * test::random_vector(12, u);
  const std::vector<body::BodyWrench> wrenches{{2, u.vec(), u.vec()}};
  ForwardDynamics dynamics(m);
  dynamics.set(q, qdot, 0.0);
  const body::AccelerationConstraints rows = body::acceleration_constraints(m, dynamics.state(), 0.0);
  const auto solution = dynamics.solve(tau, wrenches);
  body::BodyState state = body::make_state(m);
  const Eigen::VectorXd needed = body::inverse_dynamics(m, q, qdot, solution.qddot, wrenches, state);
  // Round-off, as above.
  EXPECT_LT((needed - tau - rows.A.transpose() * solution.multipliers).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((rows.A * solution.qddot - rows.b).cwiseAbs().maxCoeff(), 1e-8);
}

constexpr double kMass_kg = 1.5, kLength_m = 0.8;

/// A point mass that slides in x and y and hangs on `rods` equal rods from the origin: a pendulum.
body::BodyModel hanging_mass(int rods) {
  body::BodyModel m;
  m.bodies = {{.name = "ground"}, {.name = "mass", .mass_kg = kMass_kg}};
  body::Joint joint;
  joint.name = "plane";
  joint.child = 1;
  joint.coordinates = {0, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    joint.rotation[k].axis = joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
    if (k == 2) continue;
    joint.translation[k].coordinate = static_cast<int>(k);
    joint.translation[k].function = body::Linear{1.0, 0.0};
  }
  m.joints.push_back(joint);
  m.coordinates = {{.name = "x", .joint = 0}, {.name = "y", .joint = 0}};
  for (int k = 0; k < rods; ++k) {
    m.constraints.push_back({"rod" + std::to_string(k), "ConstantDistanceConstraint",
                             body::DistanceConstraint{.body1 = 0, .body2 = 1, .distance_m = kLength_m}});
  }
  return body::finalize(m);
}

// A pendulum of length L: acceleration -g sin(a) / L, tension m (g cos(a) + L w^2).
TEST(ForwardDynamics, ARodMakesAPendulum) {
  const double a = 0.6, w = 2.5, g = kStandardGravity;
  const Eigen::Vector2d along(std::sin(a), -std::cos(a)), across(std::cos(a), std::sin(a));
  for (const int rods : {1, 2}) {
    const body::BodyModel m = hanging_mass(rods);
    ForwardDynamics dynamics(m);
    dynamics.set(kLength_m * along, kLength_m * w * across, 0.0);
    const auto solution = dynamics.solve(Eigen::VectorXd::Zero(2), {});
    const Eigen::Vector2d expected = -g * std::sin(a) * across - kLength_m * w * w * along;
    EXPECT_LT((solution.qddot - expected).norm(), 1e-12);
    const double tension = kMass_kg * (g * std::cos(a) + kLength_m * w * w);
    // Two equal rods share the load evenly.
    for (int k = 0; k < rods; ++k) EXPECT_NEAR(solution.multipliers[k], -tension / rods, 1e-11);
  }
}

TEST(ForwardDynamics, NameTheCoordinateThatMovesNoMass) {
  body::BodyModel m = hanging_mass(0);
  m.bodies[1].mass_kg = 0.0;
  ForwardDynamics dynamics(m);
  try {
    dynamics.set(Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), 0.0);
    FAIL() << "expected an error";
  } catch (const ModelError& e) {
    EXPECT_NE(std::string(e.what()).find("without mass"), std::string::npos) << e.what();
  }
  m.coordinates[0].locked = m.coordinates[1].locked = true;
  ForwardDynamics held(m);
  held.set(Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), 0.0);
  EXPECT_EQ(held.solve(Eigen::Vector2d(1.0, 2.0), {}).qddot.norm(), 0.0);
}

}  // namespace
}  // namespace myoid::body
