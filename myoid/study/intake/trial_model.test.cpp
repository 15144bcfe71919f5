#include "myoid/study/intake/trial_model.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/resting_markers.h"
#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

TEST(TrialModel, IsTheStudysWhereTheTrialChangesNothing) {
  const Study study = arm_study();
  EXPECT_FALSE(trial_model(study, arm(), study.trials[0], {}).has_value());
}

TEST(TrialModel, HoldsTheMassAtItsPlaceAndRefusesAMassWithoutOne) {
  Study study = arm_study();
  study.trials[0].held_mass_kg = 2.0;
  study.model.held_mass = {"forearm_hand", body::arm4_held_at_m()};
  const auto own = trial_model(study, arm(), study.trials[0], {});
  ASSERT_TRUE(own.has_value());
  const auto hand = static_cast<std::size_t>(arm().find_body("forearm_hand").value());
  EXPECT_NEAR(own->bodies[hand].mass_kg, arm().bodies[hand].mass_kg + 2.0, 1e-12);
  study.model.file = "arm.osim";
  study.model.held_mass.reset();
  EXPECT_THROW((void)trial_model(study, arm(), study.trials[0], {}), InvalidInput);
}

// The markers stand where the model has them: calibration finds the coordinate's default value again.
TEST(TrialModel, HoldsACalibratedCoordinateAtItsValueInTheWindow) {
  Study study = arm_study();
  study.model.file = "arm.osim";  // no arm is made from the markers
  study.ik.calibrate = CalibrationSpec{.window_s = {0.0, 0.3}, .free = {"elbow_flexion"}, .hold = {"elbow_flexion"}};
  TrialInput input;
  input.markers = test::resting_markers(arm(), 0.0);
  body::BodyModel bent = arm();
  const auto elbow = static_cast<std::size_t>(bent.coordinate_index("elbow_flexion"));
  const double truth = bent.coordinates[elbow].default_value;
  bent.coordinates[elbow].default_value = truth + 0.2;
  const auto own = trial_model(study, bent, study.trials[0], input);
  ASSERT_TRUE(own.has_value());
  EXPECT_TRUE(own->coordinates[elbow].locked);
  EXPECT_NEAR(own->coordinates[elbow].default_value, truth, 1e-5);
}

}  // namespace
}  // namespace myoid::study
