#include "myoid/pipeline/estimator_input.h"

#include <gtest/gtest.h>

#include "tests/support/written_trial.h"

namespace myoid::pipeline {
namespace {

using namespace test_trials;

StudyResult with_one_channel() {
  StudyResult result;
  result.study = arm_study();
  result.model = arm();
  signals::ChannelNormalisation channel;
  channel.channel = "BIC";
  channel.relative_sd = 0.03;
  channel.relative_bias = 0.02;
  result.normalisation = {channel};
  return result;
}

TEST(TorqueOptions, AGainsPriorIsTheShareOfTheMaximumThatTheMvcTrialsReach) {
  StudyResult result = with_one_channel();
  result.study.emg.mvc_effort = 0.8;
  result.study.emg.mvc_effort_sd = 0.032;
  result.study.emg.has_mvc = true;
  const identification::TorqueOptions known = torque_options(result, {});
  EXPECT_NEAR(known.gain_prior_mean.at("BIC"), 0.8 * 1.02, 1e-12);
  EXPECT_NEAR(known.gain_prior_sd.at("BIC"), 0.05, 1e-12);  // 3 % and 4 %, independent
  // Without MVC the greatest effort of the study is no known share of anything.
  result.study.emg.has_mvc = false;
  const identification::TorqueOptions unknown = torque_options(result, {});
  EXPECT_NEAR(unknown.gain_prior_mean.at("BIC"), 1.02, 1e-12);
  EXPECT_NEAR(unknown.gain_prior_sd.at("BIC"), 0.03, 1e-12);
  EXPECT_FALSE(unknown.from_mvc);
}

TEST(TorqueOptions, WithTheLagsOfTheActivationTheDelayIsWhatIsLeftBesideThem) {
  StudyResult result = with_one_channel();
  EXPECT_NEAR(torque_options(result, {}).delay_prior_mean_s, 0.060, 1e-12);
  result.study.identify.dynamics = true;
  const identification::TorqueOptions lags = torque_options(result, {});
  EXPECT_TRUE(lags.dynamics);
  EXPECT_NEAR(lags.delay_prior_mean_s, 0.010, 1e-12);
  EXPECT_NEAR(lags.delay_prior_sd_s, 0.010, 1e-12);
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

}  // namespace
}  // namespace myoid::pipeline
