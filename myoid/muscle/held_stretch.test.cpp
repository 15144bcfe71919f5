#include "myoid/muscle/held_stretch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/small_muscle.h"

namespace myoid::muscle {
namespace {

/// Four seconds: isometric, stretched by `rise_m` at 1 to 1.5 s, held; driven from 0.2 to 3 s. The small muscle's
/// force.
IsolatedRecording stretched(double rise_m, double driven_until_s = 3.0) {
  IsolatedRecording r{.name = "stretch"};
  r.input.time_s = Eigen::VectorXd::LinSpaced(401, 0.0, 4.0);
  r.input.length_m = (0.04 + rise_m * ((r.input.time_s.array() - 1.0) / 0.5).min(1.0).max(0.0)).matrix();
  // A motor's noise of 0.1 % of l0.
  for (Eigen::Index k = 0; k < 401; ++k) r.input.length_m[k] += 2e-5 * std::sin(2.1 * static_cast<double>(k));
  r.input.drive_time_s = Eigen::Vector3d(0.0, 0.2, driven_until_s);
  r.input.drive = Eigen::Vector3d(0.0, 1.0, 0.0);
  r.input.drive_is_excitation = true;
  r.input.initial_activation = 0.01;
  r.time_s = r.input.time_s;
  r.force_n = isolated_force(test::small_muscle(), r, 1e-6);
  return r;
}

TEST(HeldStretch, IsFoundWhereAnActiveMuscleIsStretchedAndHeld) {
  const std::vector<HeldStretch> found = held_stretches({stretched(0.0), stretched(0.002)}, 0.02);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].recording, 1U);
  EXPECT_NEAR(found[0].begin_s, 1.0, 0.05);
  EXPECT_NEAR(found[0].end_s, 1.5, 0.05);
  EXPECT_NEAR(found[0].rise_m, 0.002, 5e-5);
  EXPECT_NEAR(found[0].held_until_s, 3.0, 0.02);
}

TEST(HeldStretch, IsNoneOfAMuscleAtRestOfASmallOneOrOfOneThatMovesOn) {
  EXPECT_TRUE(held_stretches({stretched(0.0004)}, 0.02).empty());
  EXPECT_TRUE(held_stretches({stretched(0.002, 1.7)}, 0.02).empty());  // relaxed before it was held
  IsolatedRecording rest = stretched(0.002);
  rest.input.drive.setZero();
  EXPECT_TRUE(held_stretches({rest}, 0.02).empty());
  IsolatedRecording cycle = stretched(0.002);
  for (Eigen::Index k = 160; k < 401; ++k)
    cycle.input.length_m[k] += 0.001 * std::sin(10.0 * (cycle.input.time_s[k] - 1.6));
  EXPECT_TRUE(held_stretches({cycle}, 0.02).empty());
}

TEST(HeldStretch, TheEnhancementIsTheForceAboveTheModels) {
  IsolatedRecording r = stretched(0.002);
  const HeldStretch stretch = held_stretches({r}, 0.02).at(0);
  EXPECT_NEAR(force_enhancement_n(stretch, test::small_muscle(), r), 0.0, 1e-12);
  for (Eigen::Index k = 150; k < 401; ++k) r.force_n[k] += 0.3;
  EXPECT_NEAR(force_enhancement_n(stretch, test::small_muscle(), r), 0.3, 1e-12);
  const IsolatedRecording part = before(stretch, r);
  EXPECT_LT(part.time_s[part.time_s.size() - 1], stretch.begin_s);
  EXPECT_EQ(part.time_s.size(), part.force_n.size());
}

}  // namespace
}  // namespace myoid::muscle
