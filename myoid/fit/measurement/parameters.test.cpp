#include "myoid/fit/measurement/parameters.h"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/fit/methods/plain_fit.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/error.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;
using test::freed;

TEST(ParameterMap, AnUnknownBeginsAtItsPriorsMeanUnlessARuleSaysWhere) {
  ElbowStudy study = elbow_study({.trials = 1, .seconds = 2.0, .with_priors = true});
  MuscleSetup& biceps = study.data.muscles[0];
  const double start_n = biceps.start.max_isometric_force_n;
  biceps.priors["max_isometric_force"] = {.mean = 0.3 * start_n, .sd = 0.8, .logarithmic = true};
  const auto begins = [&](const EstimatorOptions& options) {
    return ParameterMap(study.data, options).held().muscles[0][kMaxForce] / start_n;
  };
  EXPECT_NEAR(begins({}), 0.3, 1e-12);
  EXPECT_NEAR(begins({.priors = false}), 1.0, 1e-12);
  study.data.rules = {{.parameter = "max_isometric_force", .owners = {"BIC"}, .value = start_n}};
  EXPECT_NEAR(begins({}), 1.0, 1e-12);
  study.data.rules.clear();
  biceps.fixed = {"max_isometric_force"};
  EXPECT_NEAR(begins({}), 1.0, 1e-12);
}

TEST(Rules, TieFixBoundAndFreeWhatTheyName) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0, .with_priors = true});
  ParameterRule tie;
  tie.parameter = "max_isometric_force";
  tie.owners = {"BIC", "BRA"};
  tie.tie = true;
  ParameterRule fix;
  fix.parameter = "concentric_curvature";
  fix.owners = {"TRI"};
  fix.free = false;
  fix.value = 0.33;
  study.data.rules = {tie, fix, freed("max_shortening_speed", {"BRD"})};
  study.data.rules.back().upper = 3.0;
  EstimatorOptions options{.predictions = false, .marginals = false};
  options.delay_s = 0.05;
  const IdentificationResult r = identify_torque(study.data, options);
  const auto& start = study.data.muscles;
  EXPECT_NEAR(r.muscles[0].max_isometric_force_n / start[0].start.max_isometric_force_n,
              r.muscles[1].max_isometric_force_n / start[1].start.max_isometric_force_n, 1e-12);
  EXPECT_EQ(r.muscles[3].concentric_curvature, 0.33);
  EXPECT_NE(r.muscles[2].max_shortening_speed_mps, start[2].start.max_shortening_speed_mps);
  EXPECT_LE(r.muscles[2].max_shortening_speed_mps, 3.0);
  EXPECT_EQ(r.solution.size(), 4 * 6 - 1 - 1 + 1);
  study.data.rules = {freed("no_such_parameter")};
  EXPECT_THROW((void)identify_torque(study.data), InvalidInput);
  study.data.rules = {freed("max_shortening_speed", {"nobody"})};
  EXPECT_THROW((void)identify_torque(study.data), InvalidInput);
}

TEST(Rules, WhatThePapersLawLeavesOutIsFoundWhereItIsInTheData) {
  // Truth with pennation, passive force, an elastic tendon, gamma, an EMG shape and joint
  // viscosity; all freed at once, from starts off by 10 to 30 %.
  ElbowStudy study = elbow_study({.trials = 3, .seconds = 20.0});
  ModelValues truth;
  for (std::size_t k = 0; k < 4; ++k) {
    truth.muscles.push_back(
        muscle_values(study.truth[k], {.pennation_angle_rad = 0.0, .passive_force = 0.8, .length_activation = 0.12}));
  }
  truth.channels.assign(4, {study.delay_s, 1.0, -0.8, 0.04, 0.015, 0.05, 1.3});
  truth.joints.assign(1, {0.6, 0.0, 0.0, 0.4});
  for (TrialData& trial : study.data.trials) {
    const Eigen::Index n = trial.time_s.size();
    trial.angle_rad = Eigen::VectorXd::Zero(n);
    // The joint's rate from a muscle's: v = -r qdot.
    trial.velocity_radps = -trial.velocity_mps.col(0).cwiseQuotient(trial.moment_arm_m.col(0));
    trial.acceleration_radps2 = Eigen::VectorXd::Zero(n);
    trial.torque_nm = predict(study.data, trial, truth, EmgLag::delay).torque_nm;
  }
  for (MuscleSetup& setup : study.data.muscles) setup.extras = {.passive_force = 0.6, .length_activation = 0.10};
  study.data.rules = {freed("passive_force"), freed("length_activation"), freed("emg_shape"),
                      freed("emg_exponent"),  freed("joint_viscosity"),   freed("joint_torque_offset")};
  const std::optional<IdentificationResult> exact = fit_exactly(study.data, {});
  ASSERT_TRUE(exact);
  const IdentificationResult& r = *exact;
  for (std::size_t k = 0; k < 4; ++k) {
    for (const MuscleField f : {kMaxForce, kFiberLength, kLengthActivation, kPassiveForce}) {
      const double value = truth.muscles[k][static_cast<std::size_t>(f)];
      EXPECT_NEAR(r.values.muscles[k][static_cast<std::size_t>(f)], value, 1e-4 * value) << k << " " << f;
    }
    EXPECT_NEAR(r.values.channels[k][kShape], -0.8, 1e-4);
    EXPECT_NEAR(r.values.channels[k][kExponent], 1.3, 1e-4);
  }
  EXPECT_NEAR(r.values.joints[0][kViscosity], 0.6, 1e-5);
  EXPECT_NEAR(r.values.joints[0][kOffset], 0.4, 1e-5);
}

}  // namespace
}  // namespace myoid::fit
