#include "myoid/results/movable_muscles.h"

#include <gtest/gtest.h>

namespace myoid::results {
namespace {

TEST(MovableMuscles, HoldTheLawsNumbersTheirRangesAndTheSpreadAfterTheRecording) {
  fit::MuscleSetup setup;
  setup.name = "BIC";
  setup.start.max_isometric_force_n = 1000.0;
  setup.start.optimal_fiber_length_m = 0.12;
  setup.start.force_length_width_m = 0.05;
  setup.extras.pennation_angle_rad = 0.1;
  fit::IdentificationResult fit;
  fit::MuscleValues found = fit::muscle_values(setup.start, setup.extras);
  found[fit::kFiberLength] = 0.15;
  fit.values.muscles = {found};
  fit::ParameterEstimate length;
  length.muscle = "BIC";
  length.parameter = "optimal_fiber_length";
  length.estimate = 0.15;
  length.std_error = 0.03;
  length.verdict = fit::Verdict::weak;
  fit::ParameterEstimate force;
  force.muscle = "BIC";
  force.parameter = "max_isometric_force";
  force.estimate = 1000.0;
  force.prior_mean = 400.0;  // at the effort that was recorded
  fit.estimates = {length, force};

  page::Workbench workbench;
  add_movable_muscles(fit, {setup}, workbench);
  ASSERT_EQ(workbench.muscles.size(), 1U);
  ASSERT_EQ(workbench.fields.size(), std::size_t{fit::kMuscleFieldCount});
  EXPECT_EQ(workbench.fields[fit::kPennation], "pennation_angle");
  const page::MovableMuscle& muscle = workbench.muscles[0];
  EXPECT_EQ(muscle.literature[fit::kFiberLength], 0.12);
  EXPECT_EQ(muscle.identified[fit::kFiberLength], 0.15);
  EXPECT_EQ(muscle.identified[fit::kPennation], 0.1);
  ASSERT_EQ(muscle.numbers.size(), 3U);
  EXPECT_EQ(muscle.numbers[0].field, fit::kFiberLength);
  EXPECT_NEAR(muscle.numbers[0].lower, 0.06, 1e-15);
  EXPECT_NEAR(muscle.numbers[0].upper, 0.24, 1e-15);
  EXPECT_NEAR(muscle.numbers[0].sd_log, 0.2, 1e-15);
  EXPECT_EQ(muscle.numbers[0].verdict, "weak");
  EXPECT_EQ(muscle.literature[fit::kMaxForce], 400.0);
  EXPECT_NEAR(muscle.numbers[2].lower, 200.0, 1e-12);
  EXPECT_EQ(muscle.numbers[2].sd_log, 0.0);  // held
  EXPECT_EQ(muscle.correlation(0, 0), 1.0);
  EXPECT_EQ(muscle.correlation(0, 2), 0.0);
}

TEST(MovableMuscles, HaveTheDrawsOfThePosterior) {
  std::vector<fit::MuscleSetup> setups(2);
  setups[0].name = "BIC";
  setups[1].name = "BRA";
  fit::IdentificationResult fit;
  for (fit::MuscleSetup& setup : setups) {
    setup.start.optimal_fiber_length_m = 0.1;
    setup.start.force_length_width_m = 0.05;
    setup.start.max_isometric_force_n = setup.name == "BIC" ? 600.0 : 900.0;
    fit.values.muscles.push_back(fit::muscle_values(setup.start, setup.extras));
  }
  // BRA's strength is one and a half times BIC's in each draw, its length has its own, its width was held.
  fit.free_parameters = {"BRA.optimal_fiber_length", "BIC+BRA.max_isometric_force"};
  fit.draws = Eigen::MatrixXd(2, 3);
  fit.draws << 0.09, 0.1, 0.12, 500.0, 600.0, 800.0;
  fit.draw_weights = Eigen::Vector3d(0.2, 0.5, 0.3);

  page::Workbench workbench;
  add_movable_muscles(fit, setups, workbench);
  const page::MovableMuscle& bra = workbench.muscles[1];
  Eigen::MatrixXd expected(3, 3);
  expected << 0.09, 0.1, 0.12, 0.05, 0.05, 0.05, 750.0, 900.0, 1200.0;
  EXPECT_LT((bra.draws - expected).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(bra.draw_weights, fit.draw_weights);
  EXPECT_LT((workbench.muscles[0].draws.row(2) - fit.draws.row(1)).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace myoid::results
