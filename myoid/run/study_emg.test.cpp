#include "myoid/run/study_emg.h"

#include <gtest/gtest.h>

#include "tests/support/written_trial.h"

namespace myoid {
namespace {

using namespace test_trials;

/// Two seconds at rest, then three at this level.
TrialInput step_of(double level) {
  Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(5001, 0.0, 5.0);
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(5001, 1);
  values.bottomRows(3000).setConstant(level);
  TrialInput input;
  input.emg = TimeSeries(std::move(time_s), {{"BIC", Unit::volt}}, std::move(values));
  return input;
}

StudyResult processed(Study study, const std::vector<TrialInput>& inputs) {
  StudyResult result;
  study.trials.resize(inputs.size());
  result.trials.resize(inputs.size());
  process_emg_of_trials(study, inputs, result);
  return result;
}

TEST(ProcessEmgOfTrials, AnEnvelopeIsDividedByTheGreatestOfAllTrialsAndThinned) {
  const StudyResult result = processed(arm_study(), {step_of(4e-4), step_of(1e-4)});
  ASSERT_EQ(result.normalisation.size(), 1U);
  // Windows beside the step count as long as chance could have made them: less than 0.1 %.
  EXPECT_NEAR(result.normalisation[0].reference_v, 4e-4, 1e-3 * 4e-4);
  const TimeSeries& weak = result.trials[1].activation;
  EXPECT_NEAR(weak.mean_rate_hz(), 200.0, 1e-6);
  EXPECT_NEAR(weak.values()(weak.sample_count() - 100, 0), 0.25, 1e-3 * 0.25);
  EXPECT_GE(weak.values().minCoeff(), 0.0);
}

TEST(ProcessEmgOfTrials, AnActivationStaysAsItCameAndATrialWithoutEmgHasNone) {
  Study study = arm_study();
  study.emg.kind = EmgKind::activation;
  const std::vector<TrialInput> inputs{step_of(0.5), TrialInput{}};
  const StudyResult result = processed(study, inputs);
  EXPECT_EQ(result.trials[0].activation.values(), inputs[0].emg->values());
  EXPECT_TRUE(result.trials[1].activation.empty());
  EXPECT_TRUE(result.normalisation.empty());
}

}  // namespace
}  // namespace myoid
