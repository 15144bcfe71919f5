#include "myoid/run/trial_stages.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/arm/arm4.h"
#include "myoid/core/units.h"

#include "tests/support/written_trial.h"

namespace myoid {
namespace {

using namespace test_trials;

constexpr double kAngle_rad = 60.0 * kDegree;

/// The elbow held still, with this mass in the hand.
TrialResult held_still(const Study& study, double mass_kg) {
  TrialInput input;
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(201, 0.0, 2.0);
  input.motion = TimeSeries(time_s, {{"elbow_flexion", Unit::radian}},
                            Eigen::MatrixXd::Constant(201, 1, kAngle_rad));
  TrialResult trial;
  trial.spec = study.trials[0];
  trial.spec.held_mass_kg = mass_kg;
  compute_trial(study, input, "", true, {}, nullptr, trial);
  return trial;
}

TEST(ComputeTrial, AHeldMassAddsItsWeightTimesItsLever) {
  const Study study = arm_study();
  const double without_nm = held_still(study, 0.0).muscle_torque.values()(100, 0);
  const double with_nm = held_still(study, 2.0).muscle_torque.values()(100, 0);
  // The upper arm hangs: the forearm's lever about the elbow is its length times the sine.
  const double lever_m = model::arm4_held_at_m().norm() * std::sin(kAngle_rad);
  EXPECT_NEAR(with_nm - without_nm, 2.0 * 9.80665 * lever_m, 1e-3);
}

TEST(ComputeTrial, TheSharedForcesMakeTheTorque) {
  const TrialResult trial = held_still(arm_study(), 2.0);
  double torque_nm = 0.0;
  for (const Channel& muscle : trial.shared.force.channels()) {
    torque_nm += trial.shared.force.column(muscle.name)[100] *
                 trial.muscles.moment_arm.at("elbow_flexion").column(muscle.name)[100];
  }
  torque_nm += trial.shared.reserve.values()(100, 0);
  EXPECT_NEAR(torque_nm, trial.muscle_torque.values()(100, 0), 1e-6);
}

TEST(ComputeTrial, AHeldMassWithoutAPlaceIsRefused) {
  Study study = arm_study();
  const test::TemporaryFolder folder;
  recording::write_file(folder / "arm.osim", model::arm4_osim());
  study.model.file = folder / "arm.osim";
  EXPECT_NE(message_of([&] { (void)held_still(study, 2.0); }).find("does not say where it acts"),
            std::string::npos);
}

}  // namespace
}  // namespace myoid
