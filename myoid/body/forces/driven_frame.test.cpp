#include "myoid/body/forces/driven_frame.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/model/constraints.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

constexpr double kMass_kg = 2.0, kLength_m = 0.5;

/// Point masses on hinges about z, each hanging at the end of the one before.
body::BodyModel pendulum(int links) {
  body::BodyModel m;
  m.bodies.push_back({.name = "ground"});
  for (int b = 1; b <= links; ++b) {
    m.bodies.push_back({.name = "b" + std::to_string(b), .mass_kg = kMass_kg, .p_BBcm_B = Vec3(0.0, -kLength_m, 0.0)});
    body::Joint joint;
    joint.name = "j" + std::to_string(b);
    joint.parent = b - 1;
    joint.child = b;
    if (b > 1) joint.X_PF.p = Vec3(0.0, -kLength_m, 0.0);
    for (std::size_t k = 0; k < 3; ++k)
      joint.rotation[k].axis = joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
    joint.rotation[2].coordinate = b - 1;
    joint.rotation[2].function = body::Linear{1.0, 0.0};
    joint.coordinates = {b - 1};
    m.coordinates.push_back({.name = "q" + std::to_string(b), .joint = b - 1});
    m.joints.push_back(joint);
  }
  return m;
}

body::JointMotion one_frame(const Eigen::VectorXd& q, const Eigen::VectorXd& u) {
  std::vector<Channel> channels(static_cast<std::size_t>(q.size()));
  for (std::size_t k = 0; k < channels.size(); ++k) channels[k] = {"q" + std::to_string(k + 1), Unit::radian};
  const auto series = [&](const Eigen::VectorXd& v) {
    return TimeSeries(Eigen::VectorXd::Zero(1), channels, v.transpose());
  };
  return {series(q), series(u), series(Eigen::VectorXd::Zero(q.size()))};
}

TimeSeries one_force(const std::string& name, double value) {
  return {Eigen::VectorXd::Zero(1), {{name, Unit::newton}}, Eigen::MatrixXd::Constant(1, 1, value)};
}

// A point mass on a massless rod: the rod carries m (g cos q + L u^2) along itself, and nothing else.
TEST(JointReactions, ASwingingPendulumPullsAlongItsRod) {
  const body::BodyModel m = body::finalize(pendulum(1));
  const double q = 0.7, u = 3.0;
  const auto loads = joint_reactions(m, one_frame(Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, u)),
                                     one_force("none", 1.0));
  const double tension = kMass_kg * (kStandardGravity * std::cos(q) + kLength_m * u * u);
  const Vec3 up(-std::sin(q), std::cos(q), 0.0);
  EXPECT_LT((loads[0].on_child[0].f_G - tension * up).norm(), 1e-12);
  EXPECT_LT(loads[0].on_child[0].m_G.norm(), 1e-12);
}

// The upper joint of two carries both; the moment about the frame of a child that lies off the
// body's origin is that about the frame.
TEST(JointReactions, AtRestTheJointsCarryWhatHangsOnThem) {
  body::BodyModel m = pendulum(2);
  m.joints[1].X_BM.p = Vec3(0.0, 0.0, 0.1);
  m.joints[1].X_PF.p += Vec3(0.0, 0.0, 0.1);
  m = body::finalize(m);
  const auto loads =
      joint_reactions(m, one_frame(Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2)), one_force("none", 1.0));
  const Vec3 weight(0.0, kMass_kg * kStandardGravity, 0.0);
  EXPECT_LT((loads[0].on_child[0].f_G - 2.0 * weight).norm(), 1e-12);
  EXPECT_LT((loads[0].on_child[1].f_G - weight).norm(), 1e-12);
  EXPECT_LT(loads[0].on_child[0].m_G.norm(), 1e-12);
  // The weight acts in z = 0, the frame lies at z = 0.1.
  EXPECT_LT((loads[0].on_child[1].m_G - Vec3(0.0, 0.0, -0.1).cross(-weight) * -1.0).norm(), 1e-12);
}

// A locked hinge with a muscle from ground: the hinge carries weight and pull, and their moments.
TEST(JointReactions, MusclesPressTheJointsTheyCross) {
  body::BodyModel m = pendulum(1);
  m.coordinates[0].locked = true;
  body::Muscle muscle;
  muscle.name = "muscle";
  muscle.path.points = {{.name = "a", .body = 0, .p_BP = Vec3(0.1, 0.3, 0.05)},
                        {.name = "b", .body = 1, .p_BP = Vec3(0.02, -0.2, 0.0)}};
  m.muscles.push_back(muscle);
  m.force_order = {"muscle"};
  m = body::finalize(m);
  const double pull = 700.0;
  const auto loads =
      joint_reactions(m, one_frame(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1)), one_force("muscle", pull));
  const Vec3 at(0.02, -0.2, 0.0), weight(0.0, -kMass_kg * kStandardGravity, 0.0);
  const Vec3 f = pull * (Vec3(0.1, 0.3, 0.05) - at).normalized();
  EXPECT_LT((loads[0].on_child[0].f_G + f + weight).norm(), 1e-10);
  EXPECT_LT((loads[0].on_child[0].m_G + at.cross(f)).norm(), 1e-10);  // the weight has no moment
}

// Two hinges of which the second turns twice as far as the first: without gravity, and turned by a torque on the first
// coordinate alone, d'Alembert for the whole gives the force of the upper hinge.
TEST(JointReactions, CouplersShapeTheAccelerations) {
  body::BodyModel m = pendulum(2);
  m.gravity_G.setZero();
  m.couplers.push_back({.name = "c", .dependent = 1, .independent = 0, .function = body::Linear{2.0, 0.0}});
  m.actuators.push_back({{.name = "motor"}, 0});
  m.force_order = {"motor"};
  m = body::finalize(m);
  const auto loads =
      joint_reactions(m, one_frame(Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2)), one_force("motor", 3.0));
  // Angles q and 3 q from the vertical: x_1 = L q, x_2 = L q + 3 L q. (m L^2 + 16 m L^2) qdd = 3.
  const double qdd = 3.0 / (17.0 * kMass_kg * kLength_m * kLength_m);
  EXPECT_NEAR(loads[0].on_child[0].f_G.x(), kMass_kg * kLength_m * 5.0 * qdd, 1e-10);
  EXPECT_NEAR(loads[0].on_child[1].f_G.x(), kMass_kg * kLength_m * 4.0 * qdd, 1e-10);
}

// A beam that turns about its left end and hangs with its right end on a rod: at rest the hinge
// and the rod carry half the weight each. With the rod aslant by angle a, its pull is W / (2 cos
// a), and the hinge carries the horizontal part of it, too.
TEST(JointReactions, WhatClosesALoopCarriesItsShare) {
  body::BodyModel m = pendulum(1);
  m.bodies[1].p_BBcm_B = Vec3(0.5, 0.0, 0.0);
  m.bodies[1].I_BBcm_B = Vec3(0.01, 0.02, 0.02).asDiagonal();
  for (const double slant : {0.0, 0.4}) {
    m.constraints = {{"rod", "ConstantDistanceConstraint",
                      body::DistanceConstraint{.body1 = 0,
                                               .body2 = 1,
                                               .p_B1 = Vec3(1.0 + std::tan(slant), 1.0, 0.0),
                                               .p_B2 = Vec3(1.0, 0.0, 0.0),
                                               .distance_m = 1.0 / std::cos(slant)}}};
    const body::BodyModel beam = body::finalize(m);
    const auto loads =
        joint_reactions(beam, one_frame(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1)), one_force("none", 1.0));
    const double half = 0.5 * kMass_kg * kStandardGravity;
    EXPECT_LT((loads[0].on_child[0].f_G - Vec3(-half * std::tan(slant), half, 0.0)).norm(), 1e-9);
    EXPECT_LT(loads[0].on_child[0].m_G.norm(), 1e-9);
  }
}

// A motor turns a hinge whose tip ground guides along y, so that nothing moves.
TEST(JointReactions, AGuideOfTheTipAnswersAMotorInTheHinge) {
  body::BodyModel m = pendulum(1);
  m.actuators.push_back({{.name = "motor"}, 0});
  m.force_order = {"motor"};
  m.constraints = {{"guide", "PointOnLineConstraint",
                    body::LineConstraint{.body1 = 0,
                                         .body2 = 1,
                                         .direction = Vec3::UnitY(),
                                         .p_B1 = Vec3(0.0, 0.0, 0.0),
                                         .p_B2 = Vec3(0.0, -kLength_m, 0.0)}}};
  m = body::finalize(m);
  const auto loads =
      joint_reactions(m, one_frame(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1)), one_force("motor", 3.0));
  // The guide answers the motor's 3 N m with -3/L in x at the tip; the hinge with +3/L at the
  // top, and its motor's moment is part of what it carries.
  EXPECT_NEAR(loads[0].on_child[0].f_G.x(), 3.0 / kLength_m, 1e-9);
  EXPECT_NEAR(loads[0].on_child[0].m_G.z(), 3.0, 1e-9);
}

TEST(JointReactions, RefuseForcesOfOtherTimes) {
  const body::BodyModel m = body::finalize(pendulum(1));
  const auto motion = one_frame(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
  const TimeSeries two(Eigen::Vector2d(0.0, 1.0), {{"f", Unit::newton}}, Eigen::MatrixXd::Zero(2, 1));
  EXPECT_THROW((void)joint_reactions(m, motion, two), InvalidInput);
}

}  // namespace
}  // namespace myoid::body
