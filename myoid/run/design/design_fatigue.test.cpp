#include "myoid/run/design/design_fatigue.h"

#include <gtest/gtest.h>

namespace myoid::run {
namespace {

const muscle::FatigueRates<double> kRates = muscle::published_fatigue_rates("elbow_rest");

Effort minutes_at(double activation, double minutes) {
  return {{std::vector<double>(static_cast<std::size_t>(120.0 * minutes), activation)}};
}

TEST(DesignFatigue, TheEffortIsTheMeanOfThosePersonsWhoCanDoIt) {
  fit::TrialData trial;
  const Eigen::VectorXd clock = Eigen::VectorXd::LinSpaced(200, 0.0, 1.99);
  Eigen::MatrixXd activation(200, 1);
  activation << Eigen::VectorXd::Constant(100, 0.2), Eigen::VectorXd::Constant(100, 0.6);
  trial.activation = TimeSeries(clock, {{"BIC", Unit::dimensionless}}, activation);
  fit::MuscleSetup biceps;
  biceps.emg_channel = "BIC";
  const Effort effort = effort_of({trial, std::nullopt}, {biceps}, 2.0);
  ASSERT_EQ(effort.activation.at(0).size(), 4U);
  EXPECT_NEAR(effort.activation[0][0], 0.2, 1e-12);
  EXPECT_NEAR(effort.activation[0][3], 0.6, 1e-12);
}

TEST(DesignFatigue, RestsAreLongEnoughAndNoStepLongerThanNeeded) {
  const Effort hard = minutes_at(0.6, 1.0);
  const double alone = fatigued_share(hard, kRates);
  const double budget = 1.05 * alone;
  const std::vector<PlannedRest> rests = plan_rests({&hard, &hard}, budget, kRates);
  ASSERT_EQ(rests.size(), 2U);
  EXPECT_EQ(rests[0].before_s, 0.0);
  EXPECT_EQ(rests[0].fatigued_share, alone);
  EXPECT_GT(rests[1].before_s, 0.0);
  EXPECT_LE(rests[1].fatigued_share, budget);
  // 15 s less would not do: by the same law, worked out here step by step.
  muscle::FatigueState<double> state;
  for (int i = 0; i < 120; ++i) state = muscle::step_fatigue(kRates, 0.6, state, 0.5);
  for (double rest = 0.0; rest < rests[1].before_s - 15.0; rest += 15.0)
    state = muscle::step_fatigue(kRates, 0.0, state, 15.0);
  for (int i = 0; i < 120; ++i) state = muscle::step_fatigue(kRates, 0.6, state, 0.5);
  EXPECT_GT(state.fatigued, budget);
}

TEST(DesignFatigue, ABudgetThatNoRestKeepsEndsAtHalfAnHour) {
  const Effort hard = minutes_at(1.0, 2.0);
  const std::vector<PlannedRest> rests = plan_rests({&hard, &hard}, 1e-6, kRates);
  EXPECT_EQ(rests[1].before_s, 1800.0);
  EXPECT_TRUE(plan_rests({}, 0.1, kRates).empty());
}

}  // namespace
}  // namespace myoid::run
