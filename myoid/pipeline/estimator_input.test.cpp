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

}  // namespace
}  // namespace myoid::pipeline
