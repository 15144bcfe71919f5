#include "myoid/lab/virtual_person/arm_stepper.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::lab {
namespace {

TrueArm arm_with(const std::string& curves, std::uint64_t seed = 5) {
  TruthSpec spec;
  spec.curves = curves;
  math::Random random(seed);
  return draw_true_arm(spec, VirtualSubject{}, random);
}

/// An excitation of the head that is never the same, and smooth.
PerHead drive(double t) {
  PerHead u;
  for (std::size_t i = 0; i < kHeadCount; ++i) u[i] = 0.25 + 0.2 * std::sin((3.0 + 0.7 * static_cast<double>(i)) * t);
  return u;
}

/// The path of a swing that a machine imposes.
Moment swing(double t) {
  const double w = 2.0 * kPi * 0.8;
  return {1.2 - 0.7 * std::cos(w * t), 0.7 * w * std::sin(w * t), 0.7 * w * w * std::cos(w * t)};
}

TEST(ArmStepper, ForcesBalanceByTheLawsOfTheMuscleLibrary) {
  for (const std::string curves : {"de_groote", "millard"}) {
    const TrueArm arm = arm_with(curves);
    ArmStepper stepper(arm, 0.001);
    stepper.start({}, swing(0.0).value, drive(0.0));
    for (int k = 1; k <= 3000; ++k) {
      const double t = 0.001 * k;
      stepper.step_moved(drive(t), swing(t));
      if (k % 97 != 0) continue;
      const ArmState& now = stepper.state();
      for (std::size_t i = 0; i < kHeadCount; ++i) {
        // The library finds the velocity at which this fiber would be in balance; the stepper's own
        // comes from its differences. Forces agree if the library's laws, at the stepper's length
        // and velocity, balance; tables of the curves are good to 1e-6 of F_max or so.
        const TrueHead& head = arm.heads[i];
        const body::MuscleTravel path = body::travel(head.path, now.q.value);
        muscle::MusculotendonLaws laws = arm.laws;
        laws.mode = muscle::TendonMode::mass;
        const muscle::Musculotendon<double> unit(head.parameters, laws, arm.millard);
        const auto output =
            muscle::musculotendon_output(unit, {now.activation[i], path.length_m, -path.moment_arm_m * now.q.first},
                                         {now.fiber_length_m[i], now.fiber_velocity_mps[i]});
        const double f_max = head.parameters.hill.max_isometric_force_n;
        EXPECT_NEAR(output.tendon_force_n, now.tendon_force_n[i], 1e-5 * f_max) << head.name;
        EXPECT_NEAR(output.fiber_force_n * output.cos_pennation, now.tendon_force_n[i], 1e-4 * f_max)
            << head.name << " " << curves;
      }
    }
  }
}

/// Angle at the end of a free movement from rest, in steps of this length.
double end_of_free_movement_rad(const TrueArm& arm, double step_s) {
  ArmStepper stepper(arm, step_s);
  stepper.start({Plane::vertical, 1.0}, 1.0, drive(0.0));
  const int steps = static_cast<int>(std::lround(0.8 / step_s));
  for (int k = 1; k <= steps; ++k) stepper.step_free(drive(k * step_s));
  return stepper.state().q.value;
}

TEST(ArmStepper, ItsErrorFallsAtLeastInProportionToTheStep) {
  const TrueArm arm = arm_with("de_groote");
  const double fine = end_of_free_movement_rad(arm, 0.000125);
  const double error_1 = std::abs(end_of_free_movement_rad(arm, 0.001) - fine);
  const double error_2 = std::abs(end_of_free_movement_rad(arm, 0.0005) - fine);
  const double error_4 = std::abs(end_of_free_movement_rad(arm, 0.00025) - fine);
  EXPECT_LT(error_1, 2e-3);  // rad: less than markers show
  EXPECT_LT(error_2, 0.6 * error_1);
  EXPECT_LT(error_4, 0.6 * error_2);
}

TEST(ArmStepper, TheEquationOfMotionHoldsAtTheEndOfEveryStep) {
  const TrueArm arm = arm_with("millard");
  ArmStepper stepper(arm, 0.001);
  const Surroundings surroundings{Plane::vertical, 2.0};
  stepper.start(surroundings, 1.0, drive(0.0));
  for (int k = 1; k <= 500; ++k) {
    stepper.step_free(drive(0.001 * k));
    const ArmState& now = stepper.state();
    const double inertia = arm.inertia_kgm2 + 2.0 * arm.held_at_m * arm.held_at_m;
    const double weight_nm = (arm.static_moment_kgm + 2.0 * arm.held_at_m) * 9.80665;
    // Sum of the heads' forces by moment arms from differences of length (1e-16 / 1e-6, times 1 kN).
    double torque_nm = joint_passive(arm.joint, now.q.value, now.q.first).torque_nm;
    for (std::size_t i = 0; i < kHeadCount; ++i) {
      const double h = 1e-6;
      torque_nm += now.tendon_force_n[i] *
                   (body::travel(arm.heads[i].path, now.q.value - h).length_m -
                    body::travel(arm.heads[i].path, now.q.value + h).length_m) /
                   (2.0 * h);
    }
    ASSERT_NEAR(inertia * now.q.second, torque_nm - weight_nm * std::sin(now.q.value), 1e-6);
  }
}

TEST(ArmStepper, UnderAConstantDriveAnArmHeldStillStaysAsItStarted) {
  const TrueArm arm = arm_with("any");
  ArmStepper stepper(arm, 0.001);
  const PerHead u = drive(0.3);
  stepper.start({}, 1.4, u);
  const ArmState before = stepper.state();
  for (int k = 0; k < 200; ++k) stepper.step_moved(u, {1.4, 0.0, 0.0});
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    EXPECT_NEAR(stepper.state().fiber_length_m[i], before.fiber_length_m[i], 1e-9);
    EXPECT_EQ(stepper.state().activation[i], u[i]);
  }
}

TEST(ArmStepper, LessStrengthIsLessActiveForce) {
  const TrueArm arm = arm_with("de_groote");
  ArmStepper stepper(arm, 0.001);
  PerHead half;
  half.fill(0.5);
  PerHead u;
  u.fill(0.8);
  stepper.start({}, 1.4, u);
  const double fresh_n = stepper.state().tendon_force_n[2];
  stepper.set_strength(half);
  stepper.start({}, 1.4, u);
  EXPECT_NEAR(stepper.state().tendon_force_n[2] / fresh_n, 0.5, 0.1);  // the tendon stretches less
}

}  // namespace
}  // namespace myoid::lab
