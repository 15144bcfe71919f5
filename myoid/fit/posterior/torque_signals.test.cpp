#include "myoid/fit/posterior/torque_signals.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"
#include "tests/support/fascicle_study.h"
#include "tests/support/leg_study.h"

namespace myoid::fit {
namespace {

/// Compares jacobian and pull_back with differences of the signals.
void expect_derivatives(const StudyData& data) {
  EstimatorOptions options;
  for (const MuscleSetup& muscle : data.muscles) options.state(muscle.emg_channel).bandwidth_hz = 150.0;
  options.state(data.muscles.front().emg_channel).rest = 0.03;
  options.state(data.muscles[3].emg_channel).rest = 0.03;
  const ParameterMap map(data, options);
  const std::vector<TrialRun> runs = trial_runs(data, options, map);
  const Eigen::VectorXd z = map.start();
  for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
    const auto at = [&](const Eigen::VectorXd& point) {
      return RunEvaluation(runs[0], map, lag, map.values(point), nullptr).signals();
    };
    std::vector<ParameterMap::Chain> chains;
    const ModelValues values = map.values(z, &chains);
    const ChainsByOwner by_owner(map, chains);
    const RunEvaluation evaluation(runs[0], map, lag, values, &by_owner);
    // Any linear function of the signals.
    TorqueSignals by = evaluation.signals();
    const auto wave = [](Eigen::Index i, Eigen::Index j) {
      return std::sin(0.3 * static_cast<double>(i) + 1.7 * static_cast<double>(j));
    };
    by.torque_nm = Eigen::MatrixXd::NullaryExpr(by.torque_nm.size(), 1, wave);
    by.by_noise = Eigen::MatrixXd::NullaryExpr(by.by_noise.rows(), by.by_noise.cols(), wave);
    by.fiber_m = Eigen::MatrixXd::NullaryExpr(by.fiber_m.size(), 1, wave);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(z.size());
    evaluation.pull_back(by, gradient);
    const Eigen::MatrixXd jacobian = evaluation.jacobian(z.size());
    for (Eigen::Index j = 0; j < z.size(); ++j) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(z.size(), j);
      const TorqueSignals above = at(z + step), below = at(z - step);
      const double sum =
          (by.torque_nm.dot(above.torque_nm - below.torque_nm) + by.fiber_m.dot(above.fiber_m - below.fiber_m) +
           by.by_noise.cwiseProduct(above.by_noise - below.by_noise).sum()) /
          2e-5;
      EXPECT_NEAR(gradient[j], sum, 1e-4 * (1.0 + std::abs(sum))) << j;
      const Eigen::VectorXd change = (above.torque_nm - below.torque_nm) / 2e-5;
      EXPECT_LT((jacobian.col(j).head(change.size()) - change).norm(), 1e-5 * (1.0 + change.norm())) << j;
      const Eigen::VectorXd longer = (above.fiber_m - below.fiber_m) / 2e-5;
      EXPECT_LT((jacobian.col(j).tail(longer.size()) - longer).norm(), 1e-5 * (0.01 + longer.norm())) << j;
    }
  }
}

TEST(RunEvaluation, JacobianAndPullBackAreThoseOfDifferences) {
  expect_derivatives(test::elbow_study({.trials = 1, .seconds = 6.0, .with_priors = true}).data);
}

TEST(RunEvaluation, JacobianAndPullBackOfFasciclesAreThoseOfDifferences) {
  StudyData data = test::fascicle_study(test::elbow_study({.trials = 1, .seconds = 6.0, .with_priors = true}), 3).data;
  data.muscles[1].extras.pennation_angle_rad = 0.2;
  data.trials[0].fascicle_m.col(2).setConstant(std::numeric_limits<double>::quiet_NaN());
  const ParameterMap map(data, {});
  EXPECT_EQ(trial_runs(data, {}, map)[0].fascicles, (std::vector<std::size_t>{0, 1, 3}));
  expect_derivatives(data);
}

TEST(RunEvaluation, JacobianAndPullBackOfTwoJointsAreThoseOfDifferences) {
  StudyData data = test::leg_study({.trials = 1, .seconds = 6.0}).data;
  data.rules = {test::freed("joint_stiffness", {"knee"}), test::freed("joint_torque_offset"),
                test::freed("joint_viscosity", {"ankle"})};
  expect_derivatives(data);
}

TEST(RunEvaluation, WhatALargerEnvelopeMakesIsItsSecant) {
  // The plain law is proportional to the envelope: D_c is the channel's torque.
  const StudyData data = test::elbow_study({.trials = 1, .seconds = 6.0}).data;
  const ParameterMap map(data, {});
  const std::vector<TrialRun> runs = trial_runs(data, {}, map);
  const TorqueSignals signals = RunEvaluation(runs[0], map, EmgLag::delay, map.values(map.start()), nullptr).signals();
  EXPECT_LT((signals.by_noise.rowwise().sum() - signals.torque_nm).norm(), 1e-10 * signals.torque_nm.norm());
}

}  // namespace
}  // namespace myoid::fit
