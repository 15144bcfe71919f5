#include "myoid/study/intake/study_activation.h"

#include <gtest/gtest.h>

#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

/// Two seconds at rest, then three at this level.
TimeSeries step_of(double level) {
  Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(5001, 0.0, 5.0);
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(5001, 1);
  values.bottomRows(3000).setConstant(level);
  return {std::move(time_s), {{"BIC", Unit::volt}}, std::move(values)};
}

StudyActivation processed(Study study, const EmgOfTrials& emg) {
  study.trials.resize(emg.size());
  return study_activation(study, emg);
}

TEST(StudyActivation, AnEnvelopeIsDividedByTheGreatestOfAllTrialsAndThinned) {
  const TimeSeries strong_v = step_of(4e-4), weak_v = step_of(1e-4);
  const StudyActivation emg = processed(arm_study(), {&strong_v, &weak_v});
  ASSERT_EQ(emg.scale.normalisation.size(), 1U);
  // Windows beside the step count as long as chance could have made them: less than 0.1 %.
  EXPECT_NEAR(emg.scale.normalisation[0].reference_v, 4e-4, 1e-3 * 4e-4);
  const TimeSeries& weak = emg.trials[1].activation;
  EXPECT_NEAR(weak.mean_rate_hz(), 200.0, 1e-6);
  EXPECT_NEAR(weak.values()(weak.sample_count() - 100, 0), 0.25, 1e-3 * 0.25);
  EXPECT_GE(weak.values().minCoeff(), 0.0);
}

TEST(StudyActivation, AnActivationStaysAsItCameAndATrialWithoutEmgHasNone) {
  Study study = arm_study();
  study.emg.kind = EmgKind::activation;
  const TimeSeries given = step_of(0.5);
  const StudyActivation emg = processed(study, {&given, nullptr});
  EXPECT_EQ(emg.trials[0].activation.values(), given.values());
  EXPECT_TRUE(emg.trials[1].activation.empty());
  EXPECT_TRUE(emg.scale.normalisation.empty());
}

TEST(StudyActivation, AWindowThatTheStudyExcludesHasNoPartInTheGreatestEffort) {
  Study study = arm_study();
  study.trials.resize(1);
  // Two seconds at rest, then 1e-4 V, and an artefact 2.5 times as strong from 3.5 to 4 s.
  TimeSeries emg_v = step_of(1e-4);
  Eigen::MatrixXd values = emg_v.values();
  values.middleRows(3500, 501).setConstant(2.5e-4);
  emg_v = TimeSeries(emg_v.time_s(), emg_v.channels(), values);
  const auto reference_v = [&] { return study_activation(study, {&emg_v}).scale.normalisation.at(0).reference_v; };
  // The greatest mean of half a second holds the edges of the artefact.
  EXPECT_NEAR(reference_v(), 2.5e-4, 0.1 * 2.5e-4);
  study.trials[0].exclude.windows = {{3.4, 4.1}};
  EXPECT_NEAR(reference_v(), 1e-4, 1e-2 * 1e-4);
  const EmgOfTrials emg{&emg_v};
  const ComparedEnvelopes parts = envelopes_of(study, emg, study_envelopes(study, emg), false);
  ASSERT_EQ(parts.trials.size(), 2U);
  EXPECT_LT(parts.trials[0].envelope->time_s().maxCoeff(), 3.4);
  EXPECT_GT(parts.trials[1].envelope->time_s().minCoeff(), 4.1);
}

TEST(StudyActivation, ATrialThatIsHeldBackHasNoPartInTheGreatestEffort) {
  Study study = arm_study();
  study.trials.resize(2);
  study.trials[0].use = Use::validation;
  const TimeSeries strong_v = step_of(4e-4), weak_v = step_of(1e-4);
  const EmgOfTrials both{&strong_v, &weak_v};
  const StudyActivation emg = study_activation(study, both);
  EXPECT_NEAR(emg.scale.normalisation.at(0).reference_v, 1e-4, 1e-3 * 1e-4);
  // The same trials with other uses.
  study.trials[0].use = Use::calibration;
  const StudyActivation other = activation_with_uses(study, both, {&emg.trials[0], &emg.trials[1]}, emg.scale);
  EXPECT_NEAR(other.scale.normalisation.at(0).reference_v, 4e-4, 1e-3 * 4e-4);
}

TEST(StudyActivation, TheRestingLevelOfATrialThatIsHeldBackIsTheElectrodes) {
  Study study = arm_study();
  study.trials.resize(2);
  const TimeSeries quiet_v = step_of(4e-4);
  Eigen::MatrixXd noisy = step_of(2e-4).values().array() + 5e-5;  // never as quiet as the other
  const TimeSeries noisy_v(quiet_v.time_s(), quiet_v.channels(), noisy);
  const EmgOfTrials both{&quiet_v, &noisy_v};
  const StudyActivation whole = study_activation(study, both);
  study.trials[0].use = Use::validation;
  EXPECT_GT(study_activation(study, both).scale.normalisation.at(0).resting_level_v, 4e-5);
  const auto of_fold = activation_with_uses(study, both, {&whole.trials[0], &whole.trials[1]}, whole.scale);
  EXPECT_EQ(of_fold.scale.normalisation.at(0).resting_level_v, whole.scale.normalisation.at(0).resting_level_v);
  EXPECT_NEAR(of_fold.scale.normalisation.at(0).reference_v, 2.5e-4, 2e-3 * 2.5e-4);
}

}  // namespace
}  // namespace myoid::study
