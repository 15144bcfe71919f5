#include "myoid/results/movable_muscles.h"

#include <gtest/gtest.h>

namespace myoid {
namespace {

TEST(MovableMuscles, HoldTheLawsNumbersTheirRangesAndTheSpreadAfterTheRecording) {
  identification::MuscleSetup setup;
  setup.name = "BIC";
  setup.start.max_isometric_force_n = 1000.0;
  setup.start.optimal_fiber_length_m = 0.12;
  setup.start.force_length_width_m = 0.05;
  setup.extras.pennation_angle_rad = 0.1;
  identification::IdentificationResult fit;
  identification::MuscleValues found = identification::muscle_values(setup.start, setup.extras);
  found[identification::kFiberLength] = 0.15;
  fit.values.muscles = {found};
  identification::ParameterEstimate length;
  length.muscle = "BIC";
  length.parameter = "optimal_fiber_length";
  length.estimate = 0.15;
  length.std_error = 0.03;
  length.verdict = identification::Verdict::weak;
  fit.estimates = {length};

  report::Workbench workbench;
  add_movable_muscles(fit, {setup}, workbench);
  ASSERT_EQ(workbench.muscles.size(), 1U);
  ASSERT_EQ(workbench.fields.size(), std::size_t{identification::kMuscleFieldCount});
  EXPECT_EQ(workbench.fields[identification::kPennation], "pennation_angle");
  const report::MovableMuscle& muscle = workbench.muscles[0];
  EXPECT_EQ(muscle.literature[identification::kFiberLength], 0.12);
  EXPECT_EQ(muscle.identified[identification::kFiberLength], 0.15);
  EXPECT_EQ(muscle.identified[identification::kPennation], 0.1);
  ASSERT_EQ(muscle.numbers.size(), 3U);
  EXPECT_EQ(muscle.numbers[0].field, identification::kFiberLength);
  EXPECT_NEAR(muscle.numbers[0].lower, 0.06, 1e-15);
  EXPECT_NEAR(muscle.numbers[0].upper, 0.24, 1e-15);
  EXPECT_NEAR(muscle.numbers[0].sd_log, 0.2, 1e-15);
  EXPECT_EQ(muscle.numbers[0].verdict, "weak");
  EXPECT_EQ(muscle.numbers[2].sd_log, 0.0);  // held
  EXPECT_EQ(muscle.correlation(0, 0), 1.0);
  EXPECT_EQ(muscle.correlation(0, 2), 0.0);
}

}  // namespace
}  // namespace myoid
