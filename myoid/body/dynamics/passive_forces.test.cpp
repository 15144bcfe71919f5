#include "myoid/body/dynamics/passive_forces.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

body::BodyModel bare_arm() {
  body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  arm.passive_forces.clear();
  return arm;
}

/// Power of generalized forces and wrenches at the speeds of a state.
double power(const body::BodyState& state,
             const Eigen::VectorXd& generalized,
             const std::vector<body::BodyWrench>& wrenches) {
  double p = generalized.dot(state.qdot);
  for (const body::BodyWrench& w : wrenches) {
    const auto b = static_cast<std::size_t>(w.body);
    p += w.f_G.dot(state.v_GB[b]) + w.m_G.dot(state.w_GB[b]);
  }
  return p;
}

TEST(PassiveForces, ALimitForceIsFullBeyondTheTransitionAndNoneWithinTheLimits) {
  const body::CoordinateLimitForce f{.coordinate = 0,
                                     .upper_limit = 1.0,
                                     .lower_limit = -1.0,
                                     .upper_stiffness = 20.0,
                                     .lower_stiffness = 10.0,
                                     .damping = 2.0,
                                     .transition = 0.5};
  EXPECT_EQ(limit_force(f, 0.3, 5.0), 0.0);
  EXPECT_NEAR(limit_force(f, 2.0, 0.1), -20.0 * 1.0 - 2.0 * 0.1, 1e-12);
  EXPECT_NEAR(limit_force(f, -2.0, 0.1), 10.0 * 1.0 - 2.0 * 0.1, 1e-12);
  // In the middle of the transition the step is one half.
  EXPECT_NEAR(limit_force(f, 1.25, 0.0), -0.5 * 20.0 * 0.25, 1e-12);
}

TEST(PassiveForces, SpringsAndBushingsGiveThePowerTheirEnergyLoses) {
  body::BodyModel arm = bare_arm();
  const auto hand = static_cast<int>(arm.bodies.size()) - 1;
  const Pose X1{Mat3::Identity(), Vec3(0.02, 0.1, -0.03)};
  const Pose X2{Eigen::AngleAxisd(0.4, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix(), Vec3(-0.01, 0.05, 0.02)};
  arm.passive_forces.push_back(
      {"bushing", "BushingForce",
       body::Bushing{0, hand, X1, X2, Vec3(3.0, 5.0, 7.0), Vec3(100.0, 200.0, 300.0), Vec3::Zero(), Vec3::Zero()}});
  arm.passive_forces.push_back({"spring", "PointToPointSpring", body::PointSpring{0, hand, X1.p, X2.p, 250.0, 0.05}});
  const auto energy = [&](const Eigen::VectorXd& q) {
    body::BodyState s = body::make_state(arm);
    body::compute_poses(arm, q, s);
    const Pose X_GF1 = X1;
    const Pose X_GF2 = s.X_GB[static_cast<std::size_t>(hand)] * X2;
    const Mat3 R = X_GF1.R.transpose() * X_GF2.R;
    const Vec3 angle = Vec3(std::atan2(-R(1, 2), R(2, 2)), std::asin(R(0, 2)), std::atan2(-R(0, 1), R(0, 0)));
    const Vec3 shift = X_GF1.R.transpose() * (X_GF2.p - X_GF1.p);
    const double stretch = shift.norm() - 0.05;
    return 0.5 * (Vec3(3.0, 5.0, 7.0).dot(angle.cwiseAbs2()) + Vec3(100.0, 200.0, 300.0).dot(shift.cwiseAbs2()) +
                  250.0 * stretch * stretch);
  };
  const auto n = static_cast<Eigen::Index>(arm.coordinates.size());
  const Eigen::VectorXd q = arm.default_q() + Eigen::VectorXd::LinSpaced(n, 0.2, 0.5);
  const Eigen::VectorXd qdot = Eigen::VectorXd::LinSpaced(n, 1.0, -0.7);
  body::BodyState state = body::make_state(arm);
  body::compute_poses(arm, q, state);
  body::compute_velocities(arm, qdot, state);
  Eigen::VectorXd generalized = Eigen::VectorXd::Zero(n);
  std::vector<body::BodyWrench> wrenches;
  append_passive_forces(arm, state, generalized, wrenches);
  const double h = 1e-6;
  const double rate = (energy(q + h * qdot) - energy(q - h * qdot)) / (2.0 * h);
  // Central differences of an energy of some joules.
  EXPECT_NEAR(power(state, generalized, wrenches), -rate, 1e-6);
}

/// A straight path from ground to the hand.
body::MusclePath line_to_hand(const body::BodyModel& arm) {
  body::PathPoint from, to;
  from.p_BP = Vec3(0.05, 0.3, 0.1);
  to.body = static_cast<int>(arm.bodies.size()) - 1;
  to.p_BP = Vec3(0.0, -0.2, 0.01);
  return {{from, to}, {}};
}

// Along a straight line tension times lengthening speed is the power lost, whatever the law.
TEST(PassiveForces, PathSpringsAndLigamentsPullAlongTheirPathByTheirLaw) {
  body::BodyModel arm = bare_arm();
  const auto n = static_cast<Eigen::Index>(arm.coordinates.size());
  const Eigen::VectorXd q = arm.default_q() + Eigen::VectorXd::LinSpaced(n, 0.2, 0.5);
  const Eigen::VectorXd qdot = Eigen::VectorXd::LinSpaced(n, 1.0, -0.7);
  body::BodyState state = body::make_state(arm);
  body::compute_poses(arm, q, state);
  body::compute_velocities(arm, qdot, state);
  const body::MusclePath path = line_to_hand(arm);
  const auto hand = static_cast<std::size_t>(path.points[1].body);
  const Vec3 p = state.X_GB[hand] * path.points[1].p_BP;
  const Vec3 v = state.v_GB[hand] + state.w_GB[hand].cross(p - state.X_GB[hand].p);
  const double length = (p - path.points[0].p_BP).norm();
  const double speed = v.dot(p - path.points[0].p_BP) / length;
  struct Case {
    body::PassiveForce force;
    double tension_n;
  };
  const body::Function curve(body::make_piecewise_linear({0.0, 1.0, 2.0}, {0.0, 0.0, 4.0}));
  const Case cases[] = {{{"spring", "PathSpring", body::PathSpring{path, 300.0, 0.9 * length, 0.4}},
                         300.0 * 0.1 * length * (1.0 + 0.4 * speed)},
                        {{"slack", "PathSpring", body::PathSpring{path, 300.0, 1.1 * length, 0.4}}, 0.0},
                        {{"band", "Ligament", body::Ligament{path, 0.8 * length, 50.0, curve}}, 50.0 * 4.0 * 0.25}};
  for (const Case& c : cases) {
    arm.passive_forces = {c.force};
    Eigen::VectorXd generalized = Eigen::VectorXd::Zero(n);
    std::vector<body::BodyWrench> wrenches;
    append_passive_forces(arm, state, generalized, wrenches);
    EXPECT_NEAR(power(state, generalized, wrenches), -c.tension_n * speed, 1e-11) << c.force.name;
  }
}

// Formulas that say what a spring says make the spring.
TEST(PassiveForces, FormulasAndFunctionsOfSpringsAreTheSprings) {
  body::BodyModel arm = bare_arm();
  const auto n = static_cast<Eigen::Index>(arm.coordinates.size());
  const auto hand = static_cast<int>(arm.bodies.size()) - 1;
  body::BodyState state = body::make_state(arm);
  body::compute_poses(arm, arm.default_q() + Eigen::VectorXd::LinSpaced(n, 0.2, 0.5), state);
  body::compute_velocities(arm, Eigen::VectorXd::LinSpaced(n, 1.0, -0.7), state);
  const auto generalized = [&](const body::PassiveForce& force) {
    arm.passive_forces = {force};
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(n);
    std::vector<body::BodyWrench> wrenches;
    append_passive_forces(arm, state, tau, wrenches);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
    body::BodyState scratch = body::make_state(arm);
    const Eigen::VectorXd q = state.q, u = state.qdot;
    return Eigen::VectorXd(tau - body::inverse_dynamics(arm, q, u, zero, wrenches, scratch) +
                           body::inverse_dynamics(arm, q, u, zero, {}, scratch));
  };
  const Pose X1{Mat3::Identity(), Vec3(0.02, 0.1, -0.03)};
  const Pose X2{Eigen::AngleAxisd(0.4, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix(), Vec3(-0.01, 0.05, 0.02)};
  const body::Bushing linear{.body1 = 0,
                             .body2 = hand,
                             .X_BF1 = X1,
                             .X_BF2 = X2,
                             .rotational_stiffness = Vec3(3.0, 5.0, 7.0),
                             .translational_stiffness = Vec3(100.0, 200.0, 300.0)};
  body::Bushing functions = linear, formulas = linear;
  functions.rotational_stiffness = functions.translational_stiffness = Vec3::Zero();
  formulas.rotational_stiffness = formulas.translational_stiffness = Vec3::Zero();
  const std::vector<std::string> names{"theta_x", "theta_y", "theta_z", "delta_x", "delta_y", "delta_z"};
  const double stiffness[] = {3.0, 5.0, 7.0, 100.0, 200.0, 300.0};
  for (std::size_t k = 0; k < 6; ++k) {
    functions.functions.emplace_back(body::Linear{stiffness[k], 0.0});
    formulas.formulas.emplace_back(std::to_string(stiffness[k]) + "*" + names[k], names);
  }
  const Eigen::VectorXd expected = generalized({"b", "BushingForce", linear});
  EXPECT_GT(expected.norm(), 1.0);
  EXPECT_LT((generalized({"b", "", functions}) - expected).norm(), 1e-12);
  EXPECT_LT((generalized({"b", "", formulas}) - expected).norm(), 1e-12);

  const Eigen::VectorXd spring = generalized({"s", "", body::PointSpring{0, hand, X1.p, X2.p, 250.0, 0.05}});
  EXPECT_LT((generalized(
                 {"s", "", body::PointFormula{0, hand, X1.p, X2.p, body::Expression("250*(d-0.05)", {"d", "ddot"})}}) -
             spring)
                .norm(),
            1e-12);
  const Eigen::VectorXd turn = generalized({"c", "", body::CoordinateSpring{1, 8.0, 0.3, 0.2}});
  EXPECT_LT(
      (generalized({"c", "", body::CoordinateFormula{1, body::Expression("-8*(q-0.3)-0.2*qdot", {"q", "qdot"})}}) -
       turn)
          .norm(),
      1e-13);
}

TEST(PassiveForces, AForceOverTimeActsAtItsPointInItsFrame) {
  body::BodyModel arm = bare_arm();
  const auto hand = static_cast<int>(arm.bodies.size()) - 1;
  const Pose X_BF{Eigen::AngleAxisd(0.7, Vec3::UnitX()).toRotationMatrix(), Vec3(0.0, -0.2, 0.0)};
  body::BodyState state = body::make_state(arm);
  const auto n = static_cast<Eigen::Index>(arm.coordinates.size());
  body::compute_poses(arm, arm.default_q() + Eigen::VectorXd::LinSpaced(n, 0.2, 0.5), state);
  body::compute_velocities(arm, Eigen::VectorXd::Zero(n), state);
  const auto at_time = [&](body::PrescribedForce force, double time_s) {
    arm.passive_forces = {{"f", "PrescribedForce", std::move(force)}};
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(n);
    std::vector<body::BodyWrench> wrenches;
    append_passive_forces(arm, state, tau, wrenches, time_s);
    return wrenches.at(0);
  };
  const Pose X_GF = state.X_GB[static_cast<std::size_t>(hand)] * X_BF;
  const Vec3 lever = X_GF.p - state.X_GB[static_cast<std::size_t>(hand)].p;
  body::PrescribedForce f{.body = hand, .X_BF = X_BF, .force_is_global = false};
  f.force = {body::Linear{10.0, 0.0}, body::Constant{0.0}, body::Constant{2.0}};
  const body::BodyWrench local = at_time(f, 0.5);
  EXPECT_LT((local.f_G - X_GF.R * Vec3(5.0, 0.0, 2.0)).norm(), 1e-14);
  EXPECT_LT((local.m_G - lever.cross(local.f_G)).norm(), 1e-14);
  f.force_is_global = f.point_is_global = true;
  f.point = {body::Constant{1.0}, body::Constant{2.0}, body::Constant{3.0}};
  const body::BodyWrench global = at_time(f, 0.5);
  EXPECT_EQ(global.f_G, Vec3(5.0, 0.0, 2.0));
  const Vec3 arm_of_force = Vec3(1.0, 2.0, 3.0) - state.X_GB[static_cast<std::size_t>(hand)].p;
  EXPECT_LT((global.m_G - arm_of_force.cross(global.f_G)).norm(), 1e-14);
}

}  // namespace
}  // namespace myoid::body
