#include "myoid/body/simulation/simulation_model.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/passive_forces.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/body/simulation/arm_model.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/ground/core/error.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

using muscle::TendonMode;

body::BodyModel arm4() { return body::parse_osim(body::arm4_osim(), "arm4.osim"); }

std::vector<Signal> bursting() {
  const Burst flex[] = {{0.2, 0.25, 0.3}, {1.2, 0.25, 0.3}};
  const Burst extend[] = {{0.6, 0.25, 0.2}};
  const Signal flexor = bursts(flex, 0.02);
  return {flexor, flexor, flexor, bursts(extend, 0.02)};
}

// An arm whose shoulder is locked, and one whose upper arm is welded to the trunk: two trees of one arm.
TEST(SimulationModel, ALockedShoulderIsAWeldedOne) {
  for (const TendonMode mode : {TendonMode::rigid, TendonMode::equilibrium, TendonMode::mass}) {
    const ArmSetup setup{
        .model = {.mode = mode, .curves = MuscleCurves::thelen, .activation = muscle::ActivationLaw::two_lags}};
    const SimulationModel elbow = make_arm_model(setup);  // its stops keep it where the file's paths hold
    SimulationModel model = make_simulation_model(arm4(), setup.model);
    model.joints[3] = elbow.joints[0];
    model.muscles = elbow.muscles;
    const SimulationOptions options{.end_s = 2.0, .output_rate_hz = 50.0, .energy = true};
    const Simulation welded = simulate(elbow, {.excitation = bursting()}, {.q = {1.0}}, options);
    SimulationStart start = default_start(model);
    start.q[3] = 1.0;
    const Simulation tree =
        simulate(model, {.excitation = bursting(), .device = {locked(), locked(), locked(), {}}}, start, options);
    ASSERT_EQ(tree.status, math::OdeStatus::done) << tree.message;
    // Both to the tolerance of 1e-8, whose local errors accumulate.
    EXPECT_LT((tree.motion.column("elbow_flexion") - welded.motion.column("elbow_flexion")).cwiseAbs().maxCoeff(),
              1e-5);
    EXPECT_LT((tree.torque.column("elbow_flexion/muscles") - welded.torque.column("muscles")).cwiseAbs().maxCoeff(),
              2e-3);
    EXPECT_LT(energy_balance(tree).worst, 1e-6) << energy_balance(tree).where;
    EXPECT_LT(tree.motion.column("shoulder_flexion").cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(SimulationModel, FourCoordinatesFreeKeepTheirEnergyAndRequireTheirTorque) {
  const SimulationModel model = make_simulation_model(arm4(), {.joint_viscosity = 0.1});
  SimulationStart start = default_start(model);
  start.q = {0.3, -0.4, 0.2, 1.0};
  const Simulation s =
      simulate(model, {.excitation = bursting()}, start, {.end_s = 2.0, .output_rate_hz = 20.0, .energy = true});
  ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
  EXPECT_LT(energy_balance(s).worst, 1e-6) << energy_balance(s).where;
  body::BodyState state = body::make_state(model.body);
  for (Eigen::Index row = 0; row < s.motion.sample_count(); ++row) {
    Eigen::VectorXd q(4);
    Eigen::VectorXd qdot(4);
    Eigen::VectorXd qddot(4);
    Eigen::VectorXd tau(4);
    for (Eigen::Index k = 0; k < 4; ++k) {
      q[k] = s.motion.values()(row, 3 * k);
      qdot[k] = s.motion.values()(row, 3 * k + 1);
      qddot[k] = s.motion.values()(row, 3 * k + 2);
      tau[k] = s.torque.values()(row, 5 * k) + s.torque.values()(row, 5 * k + 2);
    }
    const Eigen::VectorXd required = body::inverse_dynamics(model.body, q, qdot, qddot, {}, state);
    EXPECT_LT((required - tau).cwiseAbs().maxCoeff(), 1e-8) << row;
  }
}

TEST(SimulationModel, AModelOfOthersWithWrappedPathsMoves) {
  const auto file = test::data_folder() / "opensim/arm26/model.osim";
  MYOID_REQUIRE_DATA(file);
  for (const TendonMode mode : {TendonMode::rigid, TendonMode::equilibrium, TendonMode::mass}) {
    body::BodyModel body = body::read_osim(file);
    // OpenSim's construction over an ellipsoid sets in with a jump of length, which makes energy.
    std::erase_if(body.muscles, [&](const body::Muscle& m) {
      return std::any_of(m.path.wraps.begin(), m.path.wraps.end(), [&](const auto& wrap) {
        return std::holds_alternative<body::EllipsoidShape>(
            body.wrap_objects[static_cast<std::size_t>(wrap.wrap_object)].shape);
      });
    });
    ASSERT_GE(body.muscles.size(), 3u);
    const SimulationModel model = make_simulation_model(std::move(body), {.mode = mode});
    SimulationInput input{.excitation = std::vector<Signal>(model.muscles.size(), constant(0.05)),
                          .device = default_devices(model)};
    for (std::size_t i = 0; i < model.muscles.size(); ++i) {
      if (model.muscles[i].name == "BRA") input.excitation[i] = step(0.1, 0.5, 0.05);
    }
    const Simulation s =
        simulate(model, input, default_start(model), {.end_s = 0.5, .output_rate_hz = 50.0, .energy = true});
    ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
    EXPECT_LT(energy_balance(s).worst, 1e-6) << energy_balance(s).where;
    EXPECT_GT(s.motion.column("r_elbow_flex").maxCoeff(), 0.3);
  }
}

TEST(SimulationModel, ACoupledCoordinateMovesAsItsCouplerSays) {
  body::BodyModel body = arm4();
  const int elbow = body.coordinate_index("elbow_flexion");
  const int shoulder = body.coordinate_index("shoulder_flexion");
  body.couplers = {
      {.name = "c", .dependent = elbow, .independent = shoulder, .function = body::Polynomial{{0.3, 1.2, 0.8}}}};
  const SimulationModel model = make_simulation_model(std::move(body), {.joint_viscosity = 0.05});
  SimulationStart start = default_start(model);
  start.q[static_cast<std::size_t>(shoulder)] = 0.5;
  std::vector<Device> devices(model.body.coordinates.size(), locked());
  devices[static_cast<std::size_t>(shoulder)] = {};
  devices[static_cast<std::size_t>(elbow)] = {};
  const Simulation s = simulate(model, {.excitation = bursting(), .device = devices}, start,
                                {.end_s = 1.0, .output_rate_hz = 20.0, .energy = true});
  ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
  // The coupler's forces do no work: the energy balance closes only if they are right.
  EXPECT_LT(energy_balance(s).worst, 1e-6) << energy_balance(s).where;
  const Eigen::VectorXd q = s.motion.column("shoulder_flexion");
  EXPECT_GT(q.maxCoeff() - q.minCoeff(), 0.2);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    EXPECT_NEAR(s.motion.column("elbow_flexion")[k], 0.3 * q[k] * q[k] + 1.2 * q[k] + 0.8, 1e-6);
  }
}

TEST(SimulationModel, WhatIsNotSimulatedIsRefusedOrSaid) {
  body::BodyModel loop = arm4();
  loop.constraints = {{.name = "grip", .class_name = "PointConstraint", .law = {}}};
  EXPECT_THROW((void)make_simulation_model(loop), ModelError);
  body::BodyModel motor = arm4();
  motor.actuators.push_back({{.name = "motor"}, 3});
  EXPECT_EQ(make_simulation_model(motor).idle_actuators, 1U);
  body::BodyModel sprung = arm4();
  sprung.passive_forces = {{.name = "s",
                            .class_name = "SpringGeneralizedForce",
                            .law = body::CoordinateSpring{.coordinate = 3, .stiffness = 2.0, .rest = 1.0}}};
  const SimulationModel model = make_simulation_model(sprung);
  EXPECT_EQ(model.idle_actuators, 0U);
  EXPECT_EQ(model.joints[3].stiffness_nm_per_rad, 2.0);
}

// Inverse dynamics counts the passive forces independently; its torque must equal the muscles'.
TEST(SimulationModel, PassiveForcesOfTheFileAct) {
  body::BodyModel body = arm4();
  const int elbow = body.coordinate_index("elbow_flexion");
  const auto forearm = static_cast<int>(body.bodies.size()) - 1;
  body.passive_forces = {{.name = "stop",
                          .class_name = "CoordinateLimitForce",
                          .law = body::CoordinateLimitForce{.coordinate = elbow,
                                                            .upper_limit = 1.2,
                                                            .lower_limit = 0.9,
                                                            .upper_stiffness = 8.0,
                                                            .lower_stiffness = 5.0,
                                                            .damping = 0.02}},
                         {.name = "tie",
                          .class_name = "BushingForce",
                          .law = body::Bushing{.body1 = 0,
                                               .body2 = forearm,
                                               .translational_stiffness = Vec3(30.0, 20.0, 10.0),
                                               .translational_damping = Vec3(1.0, 1.0, 1.0)}}};
  const SimulationModel model = make_simulation_model(body, {.stops = false});
  SimulationStart start = default_start(model);
  start.q = {0.3, -0.4, 0.2, 1.0};
  const Simulation s =
      simulate(model, {.excitation = bursting()}, start, {.end_s = 0.5, .output_rate_hz = 20.0, .energy = true});
  ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
  EXPECT_LT(energy_balance(s).worst, 1e-6) << energy_balance(s).where;
  body::BodyState state = body::make_state(model.body);
  double greatest = 0.0;
  for (Eigen::Index row = 0; row < s.motion.sample_count(); ++row) {
    Eigen::VectorXd q(4);
    Eigen::VectorXd qdot(4);
    Eigen::VectorXd qddot(4);
    for (Eigen::Index k = 0; k < 4; ++k) {
      q[k] = s.motion.values()(row, 3 * k);
      qdot[k] = s.motion.values()(row, 3 * k + 1);
      qddot[k] = s.motion.values()(row, 3 * k + 2);
    }
    (void)body::inverse_dynamics(model.body, q, qdot, qddot, {}, state);
    Eigen::VectorXd along = Eigen::VectorXd::Zero(4);
    std::vector<body::BodyWrench> wrenches;
    body::append_passive_forces(body, state, along, wrenches);
    const Eigen::VectorXd required = body::inverse_dynamics(model.body, q, qdot, qddot, wrenches, state) - along;
    for (Eigen::Index k = 0; k < 4; ++k) {
      EXPECT_NEAR(required[k], s.torque.values()(row, 5 * k), 1e-8) << row;
      greatest = std::max(greatest, std::abs(s.torque.values()(row, 5 * k + 2)));
    }
  }
  EXPECT_GT(greatest, 0.5);
}

TEST(SimulationModel, WhatFollowsAnotherCoordinateIsHeldByHoldingThat) {
  body::BodyModel body = arm4();
  const auto elbow = static_cast<std::size_t>(body.coordinate_index("elbow_flexion"));
  const auto shoulder = static_cast<std::size_t>(body.coordinate_index("shoulder_flexion"));
  body.couplers = {{.name = "c",
                    .dependent = static_cast<int>(elbow),
                    .independent = static_cast<int>(shoulder),
                    .function = body::Polynomial{{1.0, 0.0}}}};
  body.coordinates[elbow].locked = true;
  const SimulationModel model = make_simulation_model(body);
  std::vector<Device> devices = default_devices(model);
  EXPECT_FALSE(devices[elbow].acceleration);
  EXPECT_TRUE(devices[shoulder].acceleration);
  devices[elbow] = locked();
  EXPECT_THROW(
      (void)simulate(model, {.excitation = bursting(), .device = devices}, default_start(model), {.end_s = 0.1}),
      InvalidInput);
  body.coordinates[elbow].prescribed = body::Constant{0.3};
  EXPECT_THROW((void)make_simulation_model(body), ModelError);
}

TEST(SimulationModel, AMuscleThatMakesNoUnitIsNamed) {
  body::BodyModel body = arm4();
  body.muscles[2].properties.optimal_fiber_length_m = -1.0;
  try {
    (void)make_simulation_model(body);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find(body.muscles[2].name), std::string::npos);
  }
}

}  // namespace
}  // namespace myoid::body
