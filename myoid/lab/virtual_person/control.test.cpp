#include "myoid/lab/virtual_person/control.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/math/random.h"

namespace myoid::lab {
namespace {

TEST(Control, ActivationsExertTheTorqueAskedForAndArePositive) {
  math::Random random(5);
  for (int k = 0; k < 500; ++k) {
    const PerMuscle capacity_nm = {random.uniform(10, 40), random.uniform(10, 30), random.uniform(5, 20),
                                   -random.uniform(20, 60)};
    const double torque_nm = random.uniform(-30, 40);
    const PerMuscle a = activations_for(torque_nm, capacity_nm,
                                        {.brachioradialis = random.uniform(-1, 1),
                                         .brachialis = random.uniform(-1, 1),
                                         .co_contraction = random.uniform(0, 0.2)});
    double sum_nm = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_GT(a[i], 0.0);
      sum_nm += a[i] * capacity_nm[i];
    }
    EXPECT_NEAR(sum_nm, torque_nm, 1e-12);  // round-off of sums of up to 100 N m
  }
}

TEST(Control, FlexorsShareTheEffortInTheProportionsAskedFor) {
  const PerMuscle a = activations_for(20.0, {30.0, 20.0, 10.0, -40.0}, {.brachioradialis = 0.4});
  EXPECT_EQ(a[kBiceps], a[kBrachialis]);  // exp(0) is 1
  EXPECT_NEAR(std::log(a[kBrachioradialis] / a[kBiceps]), 0.4, 1e-14);
}

TEST(Control, TheAntagonistCoContracts) {
  // Far above 1 N m of torque the soft part has gone: (1 N m)^2 / (4 x 20 N m) / 40 N m = 3e-4.
  const PerMuscle a = activations_for(20.0, {30.0, 20.0, 10.0, -40.0}, {.co_contraction = 0.1});
  EXPECT_NEAR(a[kTriceps], 0.1, 4e-4);
}

TEST(Control, NobodyTensesTheFlexorsForAStretchedArmAtRest) {
  // Near extension the flexors have little leverage: 0.1 of 40 N m would take 0.8 of theirs.
  const PerMuscle capacity_nm = {2.5, 1.5, 1.0, -40.0};
  const PerMuscle tense = activations_for(0.0, capacity_nm, {.co_contraction = 0.1});
  const PerMuscle eased = activations_for(0.0, capacity_nm, {.co_contraction = 0.1, .eased = true});
  EXPECT_GT(tense[kBiceps], 0.8);
  // 0.1 x 5 N m x 0.3, and the soft part of half a newton meter.
  EXPECT_NEAR(eased[kTriceps], (0.15 + 0.5) / 40.0, 1e-12);
  EXPECT_NEAR(eased[kBiceps], (0.15 + 0.5) / 5.0, 1e-12);
  // Under a load and with leverage it is the share asked for.
  const PerMuscle loaded = activations_for(60.0, {60.0, 40.0, 20.0, -40.0}, {.co_contraction = 0.1, .eased = true});
  EXPECT_NEAR(loaded[kTriceps], 0.1, 5e-4);
}

}  // namespace
}  // namespace myoid::lab
