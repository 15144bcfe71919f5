#include <gtest/gtest.h>

#include "myoid/identification/residual_model.h"
#include "myoid/methods/force.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

/// Places of a muscle's shapes.
enum Shape : Eigen::Index { kConstant = 0, kEffort = 4, kLag = 6, kPerMuscle = 7 };

Eigen::VectorXd weights_of(const StudyData& data, const EstimatorOptions& options) {
  const ResidualModel model(data, options);
  return model.error_shapes(model.parameters().start()).weight;
}

TEST(ErrorShapes, WhatTheFitFindsOfAnElectrodeIsNoErrorOfTheModelBesides) {
  const StudyData data = test::elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true}).data;
  const std::string& first = data.muscles[0].emg_channel;
  const Eigen::VectorXd none = weights_of(data, {});
  EXPECT_EQ(none[kConstant], 1.0);
  EXPECT_EQ(none[kEffort], 1.0);
  // One delay for all leaves each muscle a lag of its own.
  EXPECT_EQ(none[kLag], 1.0);

  const Eigen::VectorXd gain = weights_of(data, {.gain_prior_sd = {{first, 0.05}}});
  EXPECT_EQ(gain[kConstant], 0.0);
  EXPECT_EQ(gain[kPerMuscle + kConstant], 1.0);

  EXPECT_EQ(weights_of(data, {.delay_per_channel = true})[kLag], 0.0);

  StudyData bent = data;
  bent.rules.push_back({.parameter = "emg_exponent", .owners = {first}, .free = true});
  const Eigen::VectorXd exponent = weights_of(bent, {});
  EXPECT_EQ(exponent[kEffort], 0.0);
  EXPECT_EQ(exponent[kPerMuscle + kEffort], 1.0);
}

TEST(ErrorShapes, OfLagsBesideAPureDelayOfAllOnlyTheDifferencesAreErrors) {
  const StudyData data = test::elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true}).data;
  const auto contrast = [&](const EstimatorOptions& options) {
    const ResidualModel model(data, options);
    return model.error_shapes(model.parameters().start()).contrast;
  };
  const Eigen::MatrixXd one = contrast({});
  Eigen::VectorXd lag = Eigen::VectorXd::Zero(one.rows()), other = lag;
  for (Eigen::Index k = 0; k < 4; ++k) {
    lag[kPerMuscle * k + kLag] = 1.0;
    other[kPerMuscle * k + kEffort] = 1.0;
  }
  EXPECT_LT((one * lag).norm(), 1e-15);  // all alike: that is the delay
  EXPECT_EQ(one * other, other);
  Eigen::VectorXd apart = Eigen::VectorXd::Zero(one.rows());
  apart[kLag] = 1.0;
  apart[kPerMuscle + kLag] = -1.0;
  EXPECT_LT((one * apart - apart).norm(), 1e-15);
  // A delay that is held may be wrong; that of lags depends on the movement.
  EXPECT_TRUE(contrast({.delay_s = 0.05}).isIdentity(0.0));
  EXPECT_TRUE(contrast({.lag = EmgLag::shared}).isIdentity(0.0));
}

TEST(ErrorShapes, AnElectrodeThatDrivesTwoMusclesLeavesEachAnErrorOfItsOwn) {
  StudyData data = test::elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true}).data;
  data.muscles[1].emg_channel = data.muscles[0].emg_channel;
  const Eigen::VectorXd weight = weights_of(data, {.gain_prior_sd = {{data.muscles[0].emg_channel, 0.05}}});
  EXPECT_EQ(weight[kConstant], 1.0);
  EXPECT_EQ(weight[kPerMuscle + kConstant], 1.0);
}

TEST(ErrorShapes, AMeasuredForceHasNoMomentArmBetweenItAndTheStrength) {
  StudyData data = test::elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true}).data;
  for (TrialData& trial : data.trials) trial.force_n = trial.moment_arm_m.cwiseAbs() * 1e4;
  const StudyData one = force_study(data, 0);
  EXPECT_EQ(weights_of(one, {})[kConstant], 1.0);
  const Eigen::VectorXd force = weights_of(one, {.measured_is_force = true});
  EXPECT_EQ(force[kConstant], 0.0);
  EXPECT_EQ(force[kLag], 0.0);  // the one delay is this muscle's
  StudyData held = one;
  held.rules.push_back({.parameter = "max_isometric_force", .free = false});
  EXPECT_EQ(weights_of(held, {.measured_is_force = true})[kConstant], 1.0);
}

}  // namespace
}  // namespace myoid::identification
