#include "myoid/fit/measurement/nuisances.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

StudyData moving_elbow() {
  StudyData data = test::elbow_study({.trials = 2, .seconds = 5.0}).data;
  for (TrialData& trial : data.trials) {
    const Eigen::Index n = trial.time_s.size();
    trial.angle_rad = trial.velocity_radps = trial.acceleration_radps2 = Eigen::VectorXd::Zero(n);
  }
  return data;
}

const ParameterRule* rule_of(const std::vector<ParameterRule>& rules, std::string_view parameter) {
  for (const ParameterRule& rule : rules)
    if (rule.parameter == parameter) return &rule;
  return nullptr;
}

TEST(NuisanceRules, SizeOfAJointsOwnTorqueGoesWithTheStrengthOfItsMuscles) {
  StudyData data = moving_elbow();
  const std::vector<ParameterRule> rules = nuisance_rules(data, true);
  double strength_nm = 0.0;  // both trials have the largest arms: the same movement
  for (Eigen::Index k = 0; k < 4; ++k) {
    double arm_m = 0.0;
    for (const TrialData& trial : data.trials) arm_m = std::max(arm_m, trial.moment_arm_m.col(k).cwiseAbs().maxCoeff());
    strength_nm += arm_m * data.muscles[static_cast<std::size_t>(k)].start.max_isometric_force_n;
  }
  const ParameterRule* stiffness = rule_of(rules, "joint_stiffness");
  ASSERT_NE(stiffness, nullptr);
  EXPECT_EQ(stiffness->owners, std::vector<std::string>{data.trials[0].joint});
  EXPECT_NEAR(*stiffness->prior_sd, 0.008 * strength_nm, 1e-12);
  EXPECT_EQ(*stiffness->prior_mean, 0.0);
  for (auto& muscle : data.muscles) muscle.start.max_isometric_force_n *= 2.0;
  EXPECT_NEAR(*rule_of(nuisance_rules(data, true), "joint_viscosity")->prior_sd,
              2.0 * *rule_of(rules, "joint_viscosity")->prior_sd, 1e-12);
}

TEST(NuisanceRules, ExponentsAreFreeWhereTheyAreAskedFor) {
  const StudyData data = moving_elbow();
  EXPECT_NE(rule_of(nuisance_rules(data, true), "emg_exponent"), nullptr);
  EXPECT_EQ(rule_of(nuisance_rules(data, false), "emg_exponent"), nullptr);
}

TEST(NuisanceRules, AMuscleThatNeverExertsItselfDoesNotSayHowItsEmgRises) {
  StudyData data = moving_elbow();
  // One muscle stays below half of its maximum in all trials.
  for (TrialData& trial : data.trials) {
    Eigen::MatrixXd values = trial.activation.values();
    for (Eigen::Index c = 0; c < values.cols(); ++c) values.col(c) *= (c == 1 ? 0.45 : 0.9) / values.col(c).maxCoeff();
    trial.activation = TimeSeries(trial.activation.time_s(), trial.activation.channels(), values);
  }
  const std::vector<ParameterRule> rules = nuisance_rules(data, true);
  const ParameterRule* exponent = rule_of(rules, "emg_exponent");
  ASSERT_NE(exponent, nullptr);
  EXPECT_EQ(exponent->owners.size(), 3U);
  const std::string& slack = data.trials[0].activation.channels()[1].name;
  EXPECT_EQ(std::count(exponent->owners.begin(), exponent->owners.end(), slack), 0);
}

TEST(NuisanceRules, AJointWhoseMotionIsNotKnownHasAnOffsetAlone) {
  StudyData data = moving_elbow();
  data.trials[1].velocity_radps.resize(0);
  const std::vector<ParameterRule> rules = nuisance_rules(data, true);
  EXPECT_EQ(rule_of(rules, "joint_stiffness"), nullptr);
  EXPECT_NE(rule_of(rules, "joint_torque_offset"), nullptr);
  EXPECT_NE(rule_of(rules, "length_activation"), nullptr);
  // Without moment arms there is no joint.
  for (TrialData& trial : data.trials) trial.moment_arm_m.resize(0, 0);
  EXPECT_EQ(rule_of(nuisance_rules(data, true), "joint_torque_offset"), nullptr);
}

TEST(NuisanceRules, HeldAgainTheyLeaveTheRulesOfTheStudy) {
  StudyData data = moving_elbow();
  ParameterRule own;
  own.parameter = "emg_shape";
  own.free = true;
  ParameterRule tie;
  tie.parameter = "max_isometric_force";
  tie.usual = tie.tie = true;
  data.rules = nuisance_rules(data, true);
  data.rules.insert(data.rules.end(), {tie, own});
  hold_nuisances(data);
  EXPECT_EQ(data.rules, (std::vector<ParameterRule>{tie, own}));
}

}  // namespace
}  // namespace myoid::fit
