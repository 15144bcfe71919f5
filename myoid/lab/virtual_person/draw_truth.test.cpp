#include "myoid/lab/virtual_person/draw_truth.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"

namespace myoid::lab {
namespace {

TEST(DrawBesideMuscles, SpreadsAsAFitExpectsItBeforehandAndOnlyWhereAsked) {
  TruthSpec spec;
  const BesideMuscles none = draw_beside_muscles(spec, math::Random(1));
  EXPECT_EQ(none.length_activation, 0.0);
  EXPECT_EQ(none.joint_stiffness_nm_per_rad, 0.0);
  EXPECT_EQ(none.emg_exponent[2], 1.0);
  spec.beside_muscles = true;
  constexpr int n = 4000;  // a mean square of them spreads by 2 %
  double squares[5] = {};
  for (int k = 0; k < n; ++k) {
    const BesideMuscles drawn = draw_beside_muscles(spec, math::Random(static_cast<std::uint64_t>(k)));
    EXPECT_GE(drawn.length_activation, 0.0);
    EXPECT_GE(drawn.joint_viscosity_nms_per_rad, 0.0);
    squares[0] += std::pow(drawn.length_activation / 0.1, 2) / n;
    squares[1] += std::pow(drawn.joint_torque_nm, 2) / n;
    squares[2] += std::pow(drawn.joint_stiffness_nm_per_rad, 2) / n;
    squares[3] += std::pow(drawn.joint_viscosity_nms_per_rad / 0.2, 2) / n;
    squares[4] += std::pow(std::log(drawn.emg_exponent[1]) / 0.2, 2) / n;
  }
  for (const double square : squares) EXPECT_NEAR(square, 1.0, 0.1);
}

TEST(DrawMuscles, SpreadsAsThePriorsSay) {
  const HillSet literature = body::arm4_muscles();
  math::Random random(3);
  const int n = 4000;
  double strength = 0.0;
  double shared = 0.0;
  double length = 0.0;
  for (int k = 0; k < n; ++k) {
    const HillSet drawn = draw_muscles({}, literature, random);
    const auto log_strength = [&](std::size_t i) {
      return std::log(drawn[i].max_isometric_force_n / literature[i].max_isometric_force_n);
    };
    strength += std::pow(log_strength(kBiceps), 2) / n;
    shared += log_strength(kBiceps) * log_strength(kTriceps) / n;
    length +=
        std::pow(drawn[kTriceps].optimal_fiber_length_m / literature[kTriceps].optimal_fiber_length_m - 1.0, 2) / n;
  }
  // A variance from n draws: standard error sqrt(2/n) = 2.2 %, a covariance about 3 %; four of them.
  EXPECT_NEAR(strength, 0.2 * 0.2 + 0.15 * 0.15, 0.09 * 0.0625);
  EXPECT_NEAR(shared, 0.2 * 0.2, 0.15 * 0.04);
  EXPECT_NEAR(length, 0.01, 0.0012);  // a little less: draws without sense are drawn again
}

TEST(DrawMuscles, StaysWithinWhatAMuscleCanBe) {
  const HillSet literature = body::arm4_muscles();
  math::Random random(4);
  for (int k = 0; k < 500; ++k) {
    for (const auto& muscle : draw_muscles({.spread = 2.0}, literature, random)) {
      for (const muscle::HillField& field : muscle::kHillFields) {
        ASSERT_GE(muscle.*(field.member), field.bounds.lower) << field.name;
        ASSERT_LE(muscle.*(field.member), field.bounds.upper) << field.name;
      }
    }
  }
}

TEST(DrawMuscles, WhatDoesNotVaryIsTheLiteratureAndLeavesTheRestAlone) {
  const HillSet literature = body::arm4_muscles();
  math::Random first(5);
  math::Random second(5);
  const HillSet all = draw_muscles({}, literature, first);
  const HillSet some = draw_muscles({.vary = {"optimal_fiber_length"}}, literature, second);
  EXPECT_EQ(some[0].optimal_fiber_length_m, all[0].optimal_fiber_length_m);
  EXPECT_EQ(some[0].max_isometric_force_n, literature[0].max_isometric_force_n);
  EXPECT_EQ(all[0].tendon_slack_length_m, literature[0].tendon_slack_length_m);
  EXPECT_EQ(some[0].eccentric_curvature_product, literature[0].eccentric_curvature_product);
}

TEST(DrawMuscles, GivenValuesWin) {
  math::Random random(6);
  const HillSet drawn =
      draw_muscles({.values = {{"TRI", {{"max_isometric_force", 1234.0}}}}}, body::arm4_muscles(), random);
  EXPECT_EQ(drawn[kTriceps].max_isometric_force_n, 1234.0);
}

}  // namespace
}  // namespace myoid::lab
