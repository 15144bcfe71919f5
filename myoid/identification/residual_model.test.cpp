#include "myoid/identification/residual_model.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

/// What a cost pulls back is what the matrices of `at` say, for any weights of the rows.
void expect_pull_back(const ResidualModel& model, const Eigen::VectorXd& z, const Evaluation& at) {
  const Eigen::Index n = model.sample_count();
  const Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(n, 0.3, 40.0).array().sin();
  Eigen::VectorXd by_prediction, by_channel;
  model.pull_back(
      z,
      [&](std::size_t piece, PullBack& rows) {
        const auto [trial, joint, first, count] = model.pieces()[piece];
        for (Eigen::Index i = first; i < first + count; ++i) {
          EXPECT_NEAR(rows.predicted[i], at.predicted[i], 1e-11);
          rows.by_predicted[i] = weights[i];
          for (Eigen::Index c = 0; c < rows.channel_torque.rows(); ++c) {
            EXPECT_NEAR(rows.channel_torque(c, i), at.channel_torque(c, i), 1e-11);
            rows.channel_torque(c, i) = weights[i] + static_cast<double>(c);
          }
        }
      },
      by_prediction, by_channel);
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    SCOPED_TRACE(model.parameters().free()[static_cast<std::size_t>(j)].label);
    EXPECT_NEAR(by_prediction[j], at.gradient.row(j).dot(weights), 1e-12 * at.gradient.row(j).cwiseAbs().sum());
    const int c = model.channel_of_variable(j);
    const double of_channel = c < 0 ? 0.0 : at.unfiltered.row(j).dot(weights) + c * at.unfiltered.row(j).sum();
    EXPECT_NEAR(by_channel[j], of_channel, 1e-11 * at.unfiltered.row(j).cwiseAbs().sum());
  }
}

/// Derivatives of everything that can be freed against central differences.
void expect_derivatives(const StudyData& data, const EstimatorOptions& options, Eigen::Index count) {
  const ResidualModel model(data, options);
  const auto p = model.parameters().size();
  ASSERT_EQ(p, count);
  Eigen::VectorXd z = model.parameters().start();
  for (Eigen::Index j = 0; j < p; ++j) z[j] += 0.01 * std::sin(1.0 + static_cast<double>(j));
  Evaluation at;
  model.evaluate(z, ResidualModel::Depth::gradient, at);
  for (Eigen::Index j = 0; j < p; ++j) {
    SCOPED_TRACE(model.parameters().free()[static_cast<std::size_t>(j)].label);
    const double h = 1e-6;
    Evaluation plus, minus;
    model.evaluate(z + h * Eigen::VectorXd::Unit(p, j), ResidualModel::Depth::value, plus);
    model.evaluate(z - h * Eigen::VectorXd::Unit(p, j), ResidualModel::Depth::value, minus);
    const Eigen::VectorXd difference = (plus.predicted - minus.predicted) / (2.0 * h);
    const Eigen::VectorXd derivative = at.gradient.row(j).transpose();
    // Truncation h^2, round-off 1e-16 * 60 N m / h.
    EXPECT_LT((derivative - difference).cwiseAbs().maxCoeff(), 1e-6 * std::max(1.0, derivative.cwiseAbs().maxCoeff()));
    EXPECT_GT(derivative.norm(), 0.0);
  }
  expect_pull_back(model, z, at);
}

TEST(ResidualModel, DerivativesAreThoseOfTheTorque) {
  const ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true});
  expect_derivatives(study.data, {.gain_prior_sd = {{"BIC", 0.1}, {"TRI", 0.2}}}, 4 * 6 + 1 + 2);
}

TEST(ResidualModel, DerivativesOfAllThatCanBeFreedAreThoseOfTheTorque) {
  ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0});
  TrialData& trial = study.data.trials[0];
  const Eigen::Index n = trial.time_s.size();
  trial.angle_rad = Eigen::VectorXd::LinSpaced(n, 0.1, 2.0);
  trial.velocity_radps = trial.angle_rad.array().sin();
  trial.acceleration_radps2 = trial.angle_rad.array().cos();
  // A second joint that two of the muscles cross.
  JointData shoulder{.name = "shoulder", .torque_nm = trial.torque_nm};
  shoulder.moment_arm_m = 0.5 * trial.moment_arm_m;
  shoulder.moment_arm_m.col(1).setZero();
  trial.more_joints.push_back(shoulder);
  for (MuscleSetup& setup : study.data.muscles) {
    setup.extras = {.pennation_angle_rad = 0.15,
                    .passive_force = 0.7,
                    .length_activation = 0.1,
                    .tendon_strain = setup.name == "BIC" ? 0.04 : 0.0,
                    .activation_share = 0.95};
  }
  const auto free = [&](const char* name, std::vector<std::string> owners = {}) {
    ParameterRule rule;
    rule.parameter = name;
    rule.owners = std::move(owners);
    rule.free = true;
    study.data.rules.push_back(rule);
  };
  for (const char* name : {"max_shortening_speed", "tendon_slack_length", "pennation_angle", "passive_force",
                           "passive_strain", "passive_shape", "length_activation", "activation_share", "emg_gain",
                           "emg_shape", "emg_exponent", "excitation_time", "activation_time", "deactivation_time"})
    free(name);
  free("tendon_strain", {"BIC"});
  free("eccentric_slope_ratio", {"TRI"});
  for (const char* name : {"joint_viscosity", "joint_inertia", "joint_stiffness", "joint_torque_offset"})
    free(name, {"joint"});
  ParameterRule tie;
  tie.parameter = "passive_strain";
  tie.tie = true;
  study.data.rules.push_back(tie);
  // 6 + 8 per muscle less three by the tie, one tendon, a delay and 6 per channel, 4 of the joint.
  TrialData still = trial;
  study.data.trials[0].more_joints[0].angle_rad = trial.angle_rad;
  study.data.trials[0].more_joints[0].velocity_radps = trial.velocity_radps;
  study.data.trials[0].more_joints[0].acceleration_radps2 = trial.acceleration_radps2;
  for (const bool normalised : {false, true}) {
    expect_derivatives(study.data, {.residual_cutoff_hz = {}, .normalised = normalised, .lag = EmgLag::equation_1},
                       4 * 14 - 3 + 1 + 1 + 4 * 6 + 4);
  }
}

TEST(ResidualModel, DerivativesAreThoseOfTheTorqueWhereTheDelayIsSharedAmongLags) {
  const ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true});
  expect_derivatives(study.data, {.gain_prior_sd = {{"BIC", 0.1}}, .lag = EmgLag::shared}, 4 * 6 + 1 + 1);
}

}  // namespace
}  // namespace myoid::identification
