#include "myoid/body/simulation/moving_model.h"

#include <array>

#include <gtest/gtest.h>

#include "myoid/body/arm/planar_elbow.h"
#include "myoid/body/simulation/arm_model.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

constexpr std::array kState{1.1, -2.0};
constexpr Eigen::Index kMuscleCount = 0, kJoint = 2, kDevice = 4;  // columns of the torque

TEST(MovingModel, AcceleratesAsTheTorqueOfTheClosedFormSays) {
  const SimulationModel arm = make_arm_model({.held_mass_kg = 1.0});
  const SimulationInput input{.excitation = std::vector<Signal>(4, constant(0.2))};
  const SimulationOptions options;
  MovingModel moving(arm, input, {.q = {1.1}}, options);
  moving.begin_stretch(1.0);
  std::array<double, 2> ydot{};
  moving.rate(0.5, kState.data(), ydot.data());
  SimulationRecord row = moving.make_record(1);
  moving.record(0.5, kState.data(), nullptr, 0, row);
  EXPECT_EQ(ydot[0], kState[1]);
  EXPECT_EQ(ydot[1], row.motion(0, 2));
  const double required_nm = body::required_torque_nm(body::planar_elbow(), 1.1, ydot[1], kStandardGravity, 1.0);
  EXPECT_NEAR(row.torque(0, kMuscleCount) + row.torque(0, kJoint), required_nm, 1e-12);
  EXPECT_EQ(row.torque(0, kDevice), 0.0);
}

TEST(MovingModel, ADeviceExertsWhatItsAccelerationTakes) {
  const SimulationModel arm = make_arm_model();
  const SimulationInput input{.excitation = std::vector<Signal>(4, constant(0.2)),
                              .device = {Device{.acceleration = [](double) { return 5.0; }}}};
  const SimulationOptions options;
  MovingModel moving(arm, input, {.q = {1.1}}, options);
  moving.begin_stretch(1.0);
  SimulationRecord row = moving.make_record(1);
  moving.record(0.5, kState.data(), nullptr, 0, row);
  EXPECT_EQ(row.motion(0, 2), 5.0);
  EXPECT_NEAR(row.torque(0, kMuscleCount) + row.torque(0, kJoint) + row.torque(0, kDevice),
              body::required_torque_nm(body::planar_elbow(), 1.1, 5.0, kStandardGravity), 1e-12);
}

}  // namespace
}  // namespace myoid::body
