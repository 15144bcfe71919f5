#include "myoid/lab/virtual_person/true_arm.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm7.h"
#include "myoid/ground/core/units.h"
#include "myoid/lab/virtual_person/virtual_arm.h"

namespace myoid::lab {
namespace {

TrueArm drawn_from(const TruthSpec& spec, std::uint64_t seed) {
  math::Random random(seed);
  return draw_true_arm(spec, VirtualSubject{}, random);
}

TEST(TrueArm, WithoutSpreadItIsThePublishedOneWithStretchedTendons) {
  TruthSpec spec;
  spec.spread = 0.0;
  const TrueArm arm = drawn_from(spec, 3);
  const auto published = body::arm7_heads();
  const body::PlanarElbow elbow = body::planar_elbow(arm_options({}));
  EXPECT_DOUBLE_EQ(arm.inertia_kgm2, elbow.inertia_kgm2);
  EXPECT_DOUBLE_EQ(arm.static_moment_kgm, elbow.static_moment_kgm);
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    const TrueHead& head = arm.heads[i];
    const muscle::HillParameters<double>& hill = head.parameters.hill;
    EXPECT_DOUBLE_EQ(hill.max_isometric_force_n, published[i].hill.max_isometric_force_n);
    EXPECT_DOUBLE_EQ(hill.optimal_fiber_length_m, published[i].hill.optimal_fiber_length_m);
    EXPECT_DOUBLE_EQ(head.drive, 1.0);
    for (const double q : {0.3, 1.1, 2.0})
      EXPECT_DOUBLE_EQ(body::travel(head.path, q).moment_arm_m, body::travel(published[i].path, q).moment_arm_m);
    // With the tendon at half its strain at F_max the fiber is optimal at the angle of its lump.
    const double at_rad = body::kArmOptimalAt_rad[head.muscle];
    const double along_m = body::travel(head.path, at_rad).length_m -
                           hill.tendon_slack_length_m * (1.0 + 0.5 * head.parameters.tendon_strain);
    EXPECT_NEAR(along_m, hill.optimal_fiber_length_m * std::cos(head.parameters.pennation_at_optimal_rad), 1e-15);
  }
}

TEST(TrueArm, PeopleSpreadAsThePriorsSay) {
  // 400 people; the standard deviation of a standard deviation of normals is 1 / sqrt(2 n) = 3.5 %. ln F_max of a head:
  // 0.2, 0.15 and 0.05 together are 0.255; normals cut at 2.5 have 0.954 of their width.
  constexpr int kPeople = 400;
  Eigen::VectorXd strength(kPeople);
  Eigen::VectorXd length(kPeople);
  Eigen::VectorXd arm_length(kPeople);
  int millard = 0;
  for (int k = 0; k < kPeople; ++k) {
    const TrueArm arm = drawn_from({}, static_cast<std::uint64_t>(k));
    const muscle::HillParameters<double>& hill = arm.heads[2].parameters.hill;
    strength(k) = std::log(hill.max_isometric_force_n);
    length(k) = hill.optimal_fiber_length_m / 0.0858;
    arm_length(k) = body::travel(arm.heads[2].path, 1.5).moment_arm_m;
    millard += arm.laws.length == muscle::LengthLaw::millard ? 1 : 0;
    EXPECT_GE(arm.heads[2].parameters.tendon_strain, 0.03);
    EXPECT_LE(arm.heads[2].parameters.tendon_strain, 0.06);
  }
  const auto sd = [](const Eigen::VectorXd& v) {
    return std::sqrt((v.array() - v.mean()).square().sum() / static_cast<double>(v.size() - 1));
  };
  const double cut = 0.954;
  EXPECT_NEAR(sd(strength), cut * 0.255, 0.035);
  EXPECT_NEAR(strength.mean(), std::log(987.26), 0.05);
  EXPECT_NEAR(sd(length), cut * std::hypot(0.10, 0.03), 0.014);
  EXPECT_NEAR(sd(arm_length) / arm_length.mean(), cut * 0.10, 0.014);
  EXPECT_NEAR(millard, kPeople / 2, 40);  // four standard deviations of a coin
}

TEST(TrueArm, AMusclesDriveIsTheMeanOfItsHeadsByStrength) {
  const TrueArm arm = drawn_from({}, 12);
  for (std::size_t m = 0; m < kArmMuscles.size(); ++m) {
    double strength = 0.0;
    double driven = 0.0;
    double power = 0.0;
    for (const TrueHead& head : arm.heads) {
      if (head.muscle != m) continue;
      strength += head.parameters.hill.max_isometric_force_n;
      driven += head.drive * head.parameters.hill.max_isometric_force_n;
      power += head.electrode_share;
    }
    EXPECT_NEAR(driven / strength, 1.0, 1e-14);
    EXPECT_NEAR(power, 1.0, 1e-14);
  }
}

TEST(TrueArm, RequiredTorqueIsThatOfAPendulum) {
  const TrueArm arm = drawn_from({}, 12);
  // Held out straight to the side of gravity with 2 kg and no motion: weight times lever.
  EXPECT_NEAR(required_torque_nm(arm, 0.5 * kPi, 0.0, Plane::vertical, 2.0),
              9.80665 * (arm.static_moment_kgm + 2.0 * arm.held_at_m), 1e-12);
  EXPECT_EQ(required_torque_nm(arm, 0.5 * kPi, 0.0, Plane::horizontal, 2.0), 0.0);
  EXPECT_NEAR(required_torque_nm(arm, 1.0, 3.0, Plane::horizontal, 2.0),
              3.0 * (arm.inertia_kgm2 + 2.0 * arm.held_at_m * arm.held_at_m), 1e-12);
}

}  // namespace
}  // namespace myoid::lab
