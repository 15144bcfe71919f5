#include "myoid/run/study_forces.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/forces/sharing_input.h"
#include "myoid/ground/core/units.h"

#include "tests/support/written_trial.h"

namespace myoid::run {
namespace {

using namespace test_trials;

constexpr double kAngle_rad = 60.0 * kDegree;

struct OneTrial {
  StudyInputs inputs;
  TrialMotion motion;
  TrialForces forces;
};

/// The elbow held still, with this mass in the hand.
OneTrial held_still(study::Study study, double mass_kg) {
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(201, 0.0, 2.0);
  study::TrialInput input;
  input.motion = TimeSeries(time_s, {{"elbow_flexion", Unit::radian}}, Eigen::MatrixXd::Constant(201, 1, kAngle_rad));
  study.trials[0].held_mass_kg = mass_kg;
  OneTrial one{in_memory(study, {input}), {}, {}};
  study::StudyActivation no_emg;
  no_emg.trials.resize(1);
  const std::vector<TrialMotion> motion = study_motion(one.inputs, nullptr, {});
  one.motion = motion[0];
  one.forces = study_forces(one.inputs, no_emg, motion, true, {}).trials[0];
  return one;
}

TEST(StudyForces, AHeldMassAddsItsWeightTimesItsLever) {
  const study::Study study = arm_study();
  const double without_nm = held_still(study, 0.0).forces.muscle_torque.values()(100, 0);
  const double with_nm = held_still(study, 2.0).forces.muscle_torque.values()(100, 0);
  // The upper arm hangs: the forearm's lever about the elbow is its length times the sine.
  const double lever_m = body::arm4_held_at_m().norm() * std::sin(kAngle_rad);
  EXPECT_NEAR(with_nm - without_nm, 2.0 * 9.80665 * lever_m, 1e-3);
}

TEST(StudyForces, TheSharedForcesMakeTheTorque) {
  const TrialForces trial = held_still(arm_study(), 2.0).forces;
  double torque_nm = 0.0;
  for (const Channel& muscle : trial.shared.force.channels()) {
    torque_nm += trial.shared.force.column(muscle.name)[100] *
                 trial.muscles.moment_arm.at("elbow_flexion").column(muscle.name)[100];
  }
  torque_nm += trial.shared.reserve.values()(100, 0);
  EXPECT_NEAR(torque_nm, trial.muscle_torque.values()(100, 0), 1e-6);
}

// The forces are those that `myoid so` writes: body::sharing_input on the same motion.
TEST(StudyForces, AreThoseOfMyoidSo) {
  const OneTrial one = held_still(arm_study(), 2.0);
  const body::MuscleForces so =
      body::share(body::sharing_input(*one.motion.model, one.motion.joints,
                                      body::muscle_kinematics(*one.motion.model, one.motion.joints), {"elbow_flexion"}),
                  {});
  EXPECT_EQ(one.forces.shared.force.values(), so.force.values());
  EXPECT_EQ(one.forces.shared.activation.values(), so.activation.values());
  EXPECT_EQ(one.forces.shared.reserve.values(), so.reserve.values());
}

TEST(StudyForces, ATrialWithoutMotionHasNone) {
  StudyInputs inputs = in_memory(arm_study(), {study::TrialInput{}});
  study::StudyActivation no_emg;
  no_emg.trials.resize(1);
  const StudyForces forces = study_forces(inputs, no_emg, study_motion(inputs, nullptr, {}), true, {});
  EXPECT_TRUE(forces.trials[0].failure.empty());
  EXPECT_TRUE(forces.trials[0].muscle_torque.empty());
}

}  // namespace
}  // namespace myoid::run
