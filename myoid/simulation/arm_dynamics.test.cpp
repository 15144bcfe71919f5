#include "myoid/simulation/arm_dynamics.h"

#include <array>

#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace myoid::simulation {
namespace {

TEST(ArmDynamics, PathsAreThoseOfThePlanarElbow) {
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

TEST(ArmDynamics, StatesAreThoseOfTheTendonMode) {
  for (const auto& [mode, count] :
       {std::pair{muscle::TendonMode::rigid, 2u}, std::pair{muscle::TendonMode::equilibrium, 6u},
        std::pair{muscle::TendonMode::mass, 10u}}) {
    EXPECT_EQ(ArmDynamics<double>(with_tendon_mode(make_arm(), mode)).state_count(), count);
  }
}

TEST(ArmDynamics, TheMomentArmIsTheDerivativeOfTheLength) {
  using Jet = ceres::Jet<double, 1>;
  for (const ArmMuscle<double>& m : make_arm().muscles) {
    const HingePath<Jet> path{Jet(m.path.constant_m), Jet(m.path.above_m), Jet(m.path.below_m),
                              Jet(m.path.straight_rad), Jet(m.path.pulley_m)};
    for (const double q : {0.1, 1.0, 2.3}) {
      const auto t = travel(path, Jet(q, 0));
      EXPECT_NEAR(t.moment_arm_m.a, -t.length_m.v[0], 1e-15) << m.name;
    }
  }
}

}  // namespace
}  // namespace myoid::simulation
