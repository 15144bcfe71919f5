#include "myoid/run/estimator_input.h"

#include <gtest/gtest.h>

#include "myoid/run/trial_stages.h"

#include "tests/support/written_trial.h"

namespace myoid {
namespace {

using namespace test_trials;

StudyResult with_one_channel() {
  StudyResult result;
  result.study = arm_study();
  result.model = arm();
  signals::ChannelNormalisation channel;
  channel.channel = "BIC";
  channel.relative_sd = 0.03;
  result.normalisation = {channel};
  return result;
}

TEST(TorqueOptions, AGainsPriorIsTheShareOfTheMaximumThatTheMvcTrialsReach) {
  StudyResult result = with_one_channel();
  result.study.emg.mvc_effort = 0.8;
  result.study.emg.mvc_effort_sd = 0.032;
  result.study.emg.has_mvc = true;
  const identification::TorqueOptions known = torque_options(result, {});
  EXPECT_NEAR(known.gain_prior_mean.at("BIC"), 0.8, 1e-12);
  EXPECT_NEAR(known.gain_prior_sd.at("BIC"), 0.05, 1e-12);  // 3 % and 4 %, independent
  // Without MVC the greatest effort of the study is no known share of anything.
  result.study.emg.has_mvc = false;
  const identification::TorqueOptions unknown = torque_options(result, {});
  EXPECT_NEAR(unknown.gain_prior_mean.at("BIC"), 1.0, 1e-12);
  EXPECT_NEAR(unknown.gain_prior_sd.at("BIC"), 0.03, 1e-12);
  EXPECT_FALSE(unknown.from_mvc);
}

TEST(TorqueOptions, WithTheLagsOfTheActivationTheDelayIsWhatIsLeftBesideThem) {
  StudyResult result = with_one_channel();
  EXPECT_NEAR(torque_options(result, {}).delay_prior_mean_s, 0.060, 1e-12);
  result.study.identify.dynamics = true;
  const identification::TorqueOptions lags = torque_options(result, {});
  EXPECT_EQ(lags.lag, identification::EmgLag::equation_1);
  EXPECT_NEAR(lags.delay_prior_mean_s, 0.010, 1e-12);
  EXPECT_NEAR(lags.delay_prior_sd_s, 0.010, 1e-12);
}

TEST(TorqueOptions, WhatTheDelayIsFollowsTheStudyAndElseTheRecording) {
  StudyResult result = with_one_channel();
  EXPECT_TRUE(torque_options(result, {}).choose_lag);
  result.study.identify.lag = "shared";
  EXPECT_FALSE(torque_options(result, {}).choose_lag);
  EXPECT_EQ(torque_options(result, {}).lag, identification::EmgLag::shared);
  result.study.identify.lag = "delay";
  EXPECT_FALSE(torque_options(result, {}).choose_lag);
  EXPECT_EQ(torque_options(result, {}).lag, identification::EmgLag::delay);
}

TEST(EstimatorData, AVmaxThatTheStudyDoesNotStateIsFree) {
  StudyResult result = with_one_channel();
  const auto freed = [&] {
    std::vector<std::string> owners;
    for (const identification::ParameterRule& rule : estimator_data(result).rules) {
      if (rule.parameter == "max_shortening_speed" && rule.free.value_or(false))
        owners.insert(owners.end(), rule.owners.begin(), rule.owners.end());
    }
    return owners;
  };
  ASSERT_FALSE(freed().empty());
  EXPECT_EQ(freed().size(), result.study.muscles.size());
  result.study.muscles[0].fixed = {"max_shortening_speed"};
  EXPECT_EQ(freed().size(), result.study.muscles.size() - 1);
}

TEST(EstimatorData, WithoutAMaximalContractionFMaxMayBeThatOfAnySmallerEffort) {
  StudyResult result = with_one_channel();
  const auto prior = [&] {
    return estimator_data(result).muscles[0].priors.at("max_isometric_force");
  };
  result.study.emg = {.kind = EmgKind::raw, .has_mvc = true};
  const Prior literature = prior();
  result.study.emg.has_mvc = false;
  EXPECT_LT(prior().mean, 0.5 * literature.mean);
  EXPECT_GT(prior().sd, 3.0 * literature.sd);
  // The muscle itself is what it was: so is what it starts from where it is held.
  EXPECT_EQ(estimator_data(result).muscles[0].start.max_isometric_force_n, literature.mean);
  // Activation is taken at its word.
  result.study.emg.kind = EmgKind::activation;
  EXPECT_EQ(prior(), literature);
}

TEST(EstimatorData, TheStudysOwnRulesComeLastAndTrialsWithoutMotionAreLeftOut) {
  StudyResult result = with_one_channel();
  result.study.parameters = {{.parameter = "joint_stiffness", .value = 1.0}};
  result.trials.resize(1);
  result.trials[0].spec = result.study.trials[0];
  const identification::StudyData data = estimator_data(result);
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
  TrialInput input;
  input.motion = TimeSeries(motion_s, {{"elbow_flexion", Unit::radian}},
                            Eigen::MatrixXd(motion_s.array().sin()));
  result.trials.resize(1);
  TrialResult& trial = result.trials[0];
  trial.spec = result.study.trials[0];
  compute_trial(result.study, input, "", false, {}, nullptr, trial);
  std::vector<Channel> channels;
  for (const char* name : {"BIC", "BRA", "BRD", "TRI"})
    channels.push_back({name, Unit::dimensionless});
  trial.activation = TimeSeries(emg_s, channels, Eigen::MatrixXd::Constant(emg_s.size(), 4, 0.3));
  const identification::StudyData data = estimator_data(result);
  ASSERT_EQ(data.trials.size(), 1U);
  EXPECT_NEAR(data.trials[0].time_s[0], 2.0, 0.1);
  EXPECT_NEAR(data.trials[0].time_s[data.trials[0].time_s.size() - 1], 14.5, 0.1);
  EXPECT_EQ(data.trials[0].torque_nm.size(), data.trials[0].time_s.size());
  EXPECT_NO_THROW(identification::validate(data));
}

}  // namespace
}  // namespace myoid
