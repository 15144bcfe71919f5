#include "myoid/run/estimator_input.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "myoid/fit/methods/torque.h"
#include "myoid/run/effort_prior.h"
#include "myoid/run/fit_input.h"
#include "myoid/run/study_result.h"

#include "tests/support/elbow_study.h"
#include "tests/support/written_trial.h"

namespace myoid::run {
namespace {

using namespace test_trials;

StudyResult with_one_channel() {
  StudyResult result;
  result.source.study = arm_study();
  result.source.model = std::make_shared<const body::BodyModel>(arm());
  recording::ChannelNormalisation channel;
  channel.channel = "BIC";
  channel.relative_sd = 0.03;
  result.emg.normalisation = {channel};
  return result;
}

fit::EstimatorOptions options_of(const StudyResult& result) {
  return torque_options(result.source.study, result.emg.normalisation, {});
}

fit::StudyData data_of(const StudyResult& result) { return estimator_data(fit_source(result)); }

TEST(TorqueOptions, AGainsPriorIsTheShareOfTheMaximumThatTheMvcTrialsReach) {
  StudyResult result = with_one_channel();
  result.source.study.emg.mvc_effort = 0.8;
  result.source.study.emg.mvc_effort_sd = 0.032;
  result.source.study.emg.has_mvc = true;
  const fit::EstimatorOptions known = options_of(result);
  EXPECT_NEAR(known.of("BIC").gain_mean, 0.8, 1e-12);
  EXPECT_NEAR(*known.of("BIC").gain_sd, 0.05, 1e-12);  // 3 % and 4 %, independent
  result.source.study.emg.has_mvc = false;
  EXPECT_FALSE(options_of(result).from_mvc);
}

TEST(TorqueOptions, ThePosteriorKnowsNothingOfTheEffortOfARecordingWithoutMaximum) {
  StudyResult result = with_one_channel();
  study::Study& study = result.source.study;
  const auto strength_sd = [&] { return data_of(result).muscles.front().priors.at("max_isometric_force").sd; };
  const auto bounded = [&] {
    const fit::StudyData data = data_of(result);
    return std::any_of(data.rules.begin(), data.rules.end(), [](const auto& rule) {
      return rule.parameter == "emg_gain" && rule.lower == 0.05 && rule.upper == 1.0;
    });
  };
  study.emg.has_mvc = true;
  const double literature_sd = strength_sd();
  EXPECT_FALSE(bounded());
  EXPECT_GT(options_of(result).unseen.effort, 0.0);
  study.emg.mvc_effort_sd = 0.05;  // the gain carries what the study states
  EXPECT_EQ(options_of(result).unseen.effort, 0.0);

  study.emg.has_mvc = false;
  const fit::EstimatorOptions unknown = options_of(result);
  EXPECT_NEAR(unknown.of("BIC").gain_mean, std::sqrt(0.05), 1e-12);
  const double half = -std::log(0.05) / std::sqrt(24.0);  // of the variance; the other half is the session's
  EXPECT_NEAR(*unknown.of("BIC").gain_sd, std::hypot(half, 0.03), 1e-12);
  EXPECT_NEAR(unknown.of("BIC").gain_common_sd, half, 1e-12);
  EXPECT_EQ(unknown.unseen.effort, 0.0);
  EXPECT_EQ(strength_sd(), literature_sd);
  EXPECT_TRUE(bounded());
  study.identify.gain = false;  // then F_max is the force at the largest EMG
  EXPECT_NEAR(strength_sd(), std::hypot(literature_sd, half), 1e-12);
  EXPECT_NEAR(options_of(result).unseen.strength, std::hypot(study.beliefs.strength, half), 1e-12);
  EXPECT_FALSE(bounded());
}

TEST(TorqueOptions, WithTheLagsOfTheActivationTheDelayIsWhatIsLeftBesideThem) {
  StudyResult result = with_one_channel();
  EXPECT_NEAR(options_of(result).delay_prior_mean_s, 0.060, 1e-12);
  result.source.study.identify.dynamics = true;
  const fit::EstimatorOptions lags = options_of(result);
  EXPECT_EQ(lags.law, fit::EmgLag::equation_1);
  EXPECT_NEAR(lags.delay_prior_mean_s, 0.010, 1e-12);
  EXPECT_NEAR(lags.delay_prior_sd_s, 0.010, 1e-12);
}

TEST(TorqueOptions, WhatTheDelayIsFollowsTheStudyAndElseTheRecording) {
  StudyResult result = with_one_channel();
  EXPECT_TRUE(options_of(result).choose_lag);
  result.source.study.identify.lag = fit::LagChoice::shared;
  EXPECT_FALSE(options_of(result).choose_lag);
  EXPECT_EQ(options_of(result).law, fit::EmgLag::shared);
  result.source.study.identify.lag = fit::LagChoice::delay;
  EXPECT_FALSE(options_of(result).choose_lag);
  EXPECT_EQ(options_of(result).law, fit::EmgLag::delay);
}

// `identify` makes its options from its own settings by the same function: equal settings, the same
// numbers from the same data.
TEST(TorqueOptions, TheStudyAndTheCommandLineFindTheSameNumbersInTheSameData) {
  study::Study study = arm_study("");
  study.emg.chain.lowpass_hz = fit::ActivationSource{}.envelope_cutoff_hz;
  study.emg.has_mvc = true;
  const fit::EstimatorOptions of_run = torque_options(study, {}, {});
  const fit::EstimatorOptions of_identify = fit::estimator_options({}, {}, {});
  const test::ElbowStudy elbow =
      test::elbow_study({.trials = 2, .seconds = 10.0, .delay_s = 0.05, .with_priors = true});
  const auto run = fit::identify_torque(elbow.data, of_run);
  const auto identify = fit::identify_torque(elbow.data, of_identify);
  ASSERT_EQ(run.estimates.size(), identify.estimates.size());
  for (std::size_t i = 0; i < run.estimates.size(); ++i) {
    EXPECT_EQ(run.estimates[i].estimate, identify.estimates[i].estimate);
    EXPECT_EQ(run.estimates[i].ci_low, identify.estimates[i].ci_low);
    EXPECT_EQ(run.estimates[i].ci_high, identify.estimates[i].ci_high);
    EXPECT_EQ(run.estimates[i].verdict, identify.estimates[i].verdict);
  }
}

TEST(EstimatorData, AVmaxThatTheStudyDoesNotStateIsFree) {
  StudyResult result = with_one_channel();
  const auto freed = [&] {
    std::vector<std::string> owners;
    for (const fit::ParameterRule& rule : data_of(result).rules) {
      if (rule.parameter == "max_shortening_speed" && rule.free.value_or(false))
        owners.insert(owners.end(), rule.owners.begin(), rule.owners.end());
    }
    return owners;
  };
  ASSERT_FALSE(freed().empty());
  EXPECT_EQ(freed().size(), result.source.study.muscles.size());
  result.source.study.muscles[0].fixed = {"max_shortening_speed"};
  EXPECT_EQ(freed().size(), result.source.study.muscles.size() - 1);
}

TEST(EstimatorData, WithoutAMaximalContractionFMaxMayBeThatOfAnySmallerEffort) {
  StudyResult result = with_one_channel();
  const auto prior = [&] { return data_of(result).muscles[0].priors.at("max_isometric_force"); };
  result.source.study.identify.gain = false;  // else the share of the maximum is an unknown
  result.source.study.emg = {.kind = study::EmgKind::raw, .has_mvc = true};
  const Prior literature = prior();
  result.source.study.emg.has_mvc = false;
  EXPECT_LT(prior().mean, 0.5 * literature.mean);
  EXPECT_NEAR(prior().sd, std::hypot(literature.sd, any_effort().own.sd), 1e-12);
  // The muscle itself is what it was: so is what it starts from where it is held.
  EXPECT_EQ(data_of(result).muscles[0].start.max_isometric_force_n, literature.mean);
  // Activation is taken at its word.
  result.source.study.emg.kind = study::EmgKind::activation;
  EXPECT_EQ(prior(), literature);
}

TEST(EstimatorData, TheStudysOwnRulesComeLastAndTrialsWithoutMotionAreLeftOut) {
  StudyResult result = with_one_channel();
  result.source.study.parameters = {{.parameter = "joint_stiffness", .value = 1.0}};
  result.trials.resize(1);
  result.trials[0].spec = result.source.study.trials[0];
  const fit::StudyData data = data_of(result);
  EXPECT_TRUE(data.trials.empty());
  EXPECT_EQ(data.muscles.size(), 4U);
  ASSERT_FALSE(data.rules.empty());
  EXPECT_EQ(data.rules.back().value, 1.0);
}

TEST(EstimatorData, HoldsNothingOfTheTimeWithoutEmg) {
  StudyResult result = with_one_channel();
  const test::TemporaryFolder folder;
  const Eigen::VectorXd motion_s = Eigen::VectorXd::LinSpaced(201, 0.0, 20.0);
  const Eigen::VectorXd emg_s = Eigen::VectorXd::LinSpaced(1251, 2.0, 14.5);
  study::TrialInput input;
  input.motion = TimeSeries(motion_s, {{"elbow_flexion", Unit::radian}}, Eigen::MatrixXd(motion_s.array().sin()));
  result.trials.resize(1);
  TrialResult& trial = result.trials[0];
  trial.spec = result.source.study.trials[0];
  trial.motion = trial_motion(result.source, trial.spec, input, nullptr);
  trial.forces = trial_torques(result.source, trial.spec, input, trial.motion);
  std::vector<Channel> channels;
  for (const char* name : {"BIC", "BRA", "BRD", "TRI"}) channels.push_back({name, Unit::dimensionless});
  trial.emg.activation = TimeSeries(emg_s, channels, Eigen::MatrixXd::Constant(emg_s.size(), 4, 0.3));
  const fit::StudyData data = data_of(result);
  ASSERT_EQ(data.trials.size(), 1U);
  EXPECT_NEAR(data.trials[0].time_s[0], 2.0, 0.1);
  EXPECT_NEAR(data.trials[0].time_s[data.trials[0].time_s.size() - 1], 14.5, 0.1);
  EXPECT_EQ(data.trials[0].torque_nm.size(), data.trials[0].time_s.size());
  EXPECT_NO_THROW(fit::validate(data));
  // No dynamometer measured a part of the torque.
  EXPECT_EQ(data.trials[0].dynamics_nm.size(), 0);
  // Windows of the study are neither fitted nor scored.
  trial.spec.exclude.windows = {{3.045, 4.045}, {9.945, 12.045}};
  const fit::TrialData without = data_of(result).trials.at(0);
  const std::vector<Eigen::Index> rows = fit::included_rows(without);
  // The analysis has a sample each 0.01 s: 3.05 to 4.04 s and 9.95 to 12.04 s.
  EXPECT_EQ(std::ssize(rows), without.time_s.size() - 100 - 210);
  for (const Eigen::Index row : rows) {
    const double t = without.time_s[row];
    EXPECT_FALSE((t > 3.045 && t < 4.045) || (t > 9.945 && t < 12.045)) << t;
  }
}

TEST(EstimatorData, BesideADynamometerWeightAndInertiaAreAPartOfTheTorque) {
  StudyResult result = with_one_channel();
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(201, 0.0, 4.0);
  study::TrialInput input;
  input.motion = TimeSeries(t, {{"elbow_flexion", Unit::radian}}, Eigen::MatrixXd(t.array().sin()));
  const Eigen::MatrixXd pushed = Eigen::MatrixXd(-20.0 * t);
  input.external_torque = TimeSeries(t, {{"elbow_flexion_moment", Unit::newton_meter}}, pushed);
  result.trials.resize(1);
  TrialResult& trial = result.trials[0];
  trial.spec = result.source.study.trials[0];
  trial.spec.external_torque = "push.sto";
  trial.motion = trial_motion(result.source, trial.spec, input, nullptr);
  trial.forces = trial_torques(result.source, trial.spec, input, trial.motion);
  std::vector<Channel> channels;
  for (const char* name : {"BIC", "BRA", "BRD", "TRI"}) channels.push_back({name, Unit::dimensionless});
  trial.emg.activation = TimeSeries(t, channels, Eigen::MatrixXd::Constant(t.size(), 4, 0.3));
  const fit::TrialData of = data_of(result).trials.at(0);
  ASSERT_EQ(of.dynamics_nm.size(), of.time_s.size());
  // The rest is what the dynamometer shows: 20 N m/s against the muscles.
  EXPECT_LT((of.torque_nm - of.dynamics_nm - 20.0 * of.time_s).norm(), 1e-6 * of.torque_nm.norm());
  EXPECT_GT(of.dynamics_nm.norm(), 0.01 * of.torque_nm.norm());
}

}  // namespace
}  // namespace myoid::run
