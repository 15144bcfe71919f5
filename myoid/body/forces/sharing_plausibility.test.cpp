#include "myoid/body/forces/sharing_plausibility.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/ground/core/units.h"

#include "tests/support/built_in_arm.h"

namespace myoid::body {
namespace {

/// The elbow bends slowly with muscles of this share of their strength.
std::vector<Remark> found(double strength,
                          const std::vector<std::string>& coordinates,
                          const std::vector<std::string>& only = {}) {
  body::BodyModel arm = test::built_in_arm();
  std::erase_if(arm.muscles, [&](const body::Muscle& muscle) {
    return !only.empty() && std::ranges::find(only, muscle.name) == only.end();
  });
  for (body::Muscle& muscle : arm.muscles) muscle.properties.max_isometric_force_n *= strength;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(101, 0.0, 4.0);
  const TimeSeries q(t, {{"elbow_flexion", Unit::radian}}, (1.2 + 0.5 * (1.5 * t.array()).sin()).matrix());
  const body::JointMotion motion = body::joint_motion(arm, q).motion;
  const SharingInput input = sharing_input(arm, motion, body::muscle_kinematics(arm, motion), coordinates);
  return reserves_act(input, share(input, {}));
}

TEST(ReservesAct, WhereTheMusclesAreTooWeakForTheTorque) {
  EXPECT_TRUE(found(1.0, {"elbow_flexion"}).empty());
  const std::vector<Remark> weak = found(0.01, {"elbow_flexion"});
  ASSERT_EQ(weak.size(), 1U);
  EXPECT_EQ(weak[0].code, RemarkCode::reserves_act);
  EXPECT_EQ(weak[0].severity, Severity::warning);
  EXPECT_EQ(weak[0].about, "elbow_flexion");
  EXPECT_EQ(weak[0].value, 1.0);
}

TEST(ReservesAct, OnACoordinateThatNoMuscleMovesIsANote) {
  // BRA and BRD cross the elbow alone: a reserve holds the shoulder.
  const std::vector<Remark> all = found(1.0, {"shoulder_flexion", "elbow_flexion"}, {"BRA", "BRD"});
  const auto shoulder = std::ranges::find(all, "shoulder_flexion", &Remark::about);
  ASSERT_NE(shoulder, all.end());
  EXPECT_EQ(shoulder->severity, Severity::note);
  EXPECT_EQ(shoulder->value, 1.0);
}

}  // namespace
}  // namespace myoid::body
