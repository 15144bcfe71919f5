#include "myoid/simulation/arm.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/simulation/arm_dynamics.h"

namespace myoid::simulation {
namespace {

TEST(Arm, ItsPathsAreThoseOfThePlanarElbow) {
  const Arm<double> arm = make_arm();
  const model::PlanarElbow elbow = model::planar_elbow();
  ASSERT_EQ(arm.muscles.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    for (const double q : {0.0, 0.8, 2.2}) {
      const auto ours = travel(arm.muscles[i].path, q);
      const auto theirs = model::travel(elbow.muscles[i], q);
      EXPECT_NEAR(ours.length_m, theirs.length_m, 1e-15);
      EXPECT_NEAR(ours.moment_arm_m, theirs.moment_arm_m, 1e-15);
    }
  }
}

TEST(Arm, StatesAreThoseOfTheTendonMode) {
  for (const auto& [mode, count] :
       {std::pair{muscle::TendonMode::rigid, 2u}, std::pair{muscle::TendonMode::equilibrium, 6u},
        std::pair{muscle::TendonMode::mass, 10u}}) {
    EXPECT_EQ(ArmDynamics<double>(with_tendon_mode(make_arm(), mode)).state_count(), count);
  }
}

TEST(Arm, WhatCannotMoveIsRefused) {
  EXPECT_THROW((void)make_arm({.held_mass_kg = -1.0}), InvalidInput);
  Arm<double> arm = make_arm();
  arm.inertia_kgm2 = 0.0;
  EXPECT_THROW(validate(arm), InvalidInput);
  arm = make_arm();
  arm.muscles[1].parameters.hill.max_isometric_force_n = -1.0;
  EXPECT_THROW(validate(arm), InvalidInput);
}

}  // namespace
}  // namespace myoid::simulation
