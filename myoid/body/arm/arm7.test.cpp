#include "myoid/body/arm/arm7.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

TEST(Arm7, HeadsOfALumpAddUpToItAndTurnTheElbowAlike) {
  const auto heads = arm7_heads();
  const auto lumped = arm4_muscles();
  const PlanarElbow elbow = planar_elbow();
  std::array<double, 4> strength_n = {};
  for (const ArmHead& head : heads) {
    const auto lump = static_cast<std::size_t>(head.lump);
    strength_n[lump] += head.hill.max_isometric_force_n;
    for (const double q : {0.2, 1.0, 2.2})
      EXPECT_EQ(travel(head.path, q).moment_arm_m, travel(elbow.muscles[lump], q).moment_arm_m);
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(strength_n[i], lumped[i].max_isometric_force_n, 1e-9);
}

TEST(Arm7, RigidTendonsLeaveEveryFiberOptimalAtTheAngleOfItsLump) {
  for (const ArmHead& head : arm7_heads()) {
    const double q = kArmOptimalAt_rad[static_cast<std::size_t>(head.lump)];
    const double along_m = travel(head.path, q).length_m - head.hill.tendon_slack_length_m;
    const double height_m = head.hill.optimal_fiber_length_m * std::sin(head.pennation_at_optimal_rad);
    EXPECT_NEAR(std::hypot(along_m, height_m), head.hill.optimal_fiber_length_m, 1e-15) << head.path.name;
  }
}

TEST(Arm7, ItsFileIsReadWithoutRemarkAndHasTheHeads) {
  const BodyModel arm = parse_osim(arm7_osim(), "arm7.osim");
  EXPECT_TRUE(arm.notes.empty()) << arm.notes.front().says;
  EXPECT_TRUE(arm.unsupported.empty()) << arm.unsupported.front();
  ASSERT_EQ(arm.muscles.size(), kArm7Heads.size());
  for (std::size_t i = 0; i < kArm7Heads.size(); ++i) EXPECT_EQ(arm.muscles[i].name, kArm7Heads[i]);
}

}  // namespace
}  // namespace myoid::body
