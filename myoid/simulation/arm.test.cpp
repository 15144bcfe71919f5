#include "myoid/simulation/arm.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::simulation {
namespace {

TEST(Arm, IsThePlanarElbowWithTheLiteraturesMuscles) {
  const Arm<double> arm = make_arm({.held_mass_kg = 2.0});
  const auto muscles = model::arm4_muscles();
  ASSERT_EQ(arm.muscles.size(), muscles.size());
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    EXPECT_EQ(arm.muscles[i].parameters.hill.max_isometric_force_n, muscles[i].max_isometric_force_n);
  }
  EXPECT_EQ(arm.held_mass_kg, 2.0);
  EXPECT_GT(arm.gravity_mps2, 9.8);
  EXPECT_EQ(make_arm({.horizontal = true}).gravity_mps2, 0.0);
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
