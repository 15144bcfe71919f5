#include "myoid/methods/force_loop.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/identification/muscle_activation.h"
#include "myoid/methods/torque.h"

#include "tests/support/elbow_study.h"
#include "tests/support/leg_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

template <class Muscles>
std::vector<MuscleValues> values_of(const Muscles& muscles) {
  std::vector<MuscleValues> values;
  for (const auto& hill : muscles) values.push_back(muscle_values(hill));
  return values;
}

Eigen::MatrixXd trial_activation(const ElbowStudy& study, const TrialData& trial) {
  return muscle_activation(study.data, trial, trial.time_s, study.delay_s);
}

ElbowStudy short_study() {
  return elbow_study({.trials = 2, .seconds = 8.0, .rate_hz = 50.0, .delay_s = 0.0, .with_priors = true});
}

TEST(InformedForces, WithTheTrueMusclesTheTrueForcesNeedNoReserve) {
  const ElbowStudy study = short_study();
  for (const TrialData& trial : study.data.trials) {
    // The muscles are right and so is the EMG: a = e balances the torque. A term sum a^2 beside
    // W sum (a - e)^2 would pull a towards zero by about 1 / W.
    const InformedForces found =
        informed_forces(trial, trial_activation(study, trial), values_of(study.truth), {.emg_weight = 1e6});
    EXPECT_LT((found.activation - found.measured).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LT((found.force_n - trial.force_n).cwiseAbs().maxCoeff(), 0.01);
    EXPECT_LT(found.reserve_nm.cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_EQ(found.frames_not_solved, 0);
  }
}

TEST(InformedForces, TheTorqueIsAlwaysBalanced) {
  const ElbowStudy study = short_study();
  const TrialData& trial = study.data.trials[0];
  for (const double weight : {0.0, 1.0, 100.0}) {
    const InformedForces found = informed_forces(trial, trial_activation(study, trial),
                                                 values_of(model::arm4_muscles()), {.emg_weight = weight});
    const Eigen::VectorXd torque = trial.moment_arm_m.cwiseProduct(found.force_n).rowwise().sum() + found.reserve_nm;
    EXPECT_LT((torque - trial.torque_nm).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_GE(found.activation.minCoeff(), 0.0);
    EXPECT_LE(found.activation.maxCoeff(), 1.0);
  }
}

TEST(InformedForces, WithoutTheEmgAntagonistsNeverActTogether) {
  // Static optimization of one joint assigns nothing to the side that the torque does not need
  // (science: a trap); the EMG of this study shows both at work all the time.
  const ElbowStudy study = short_study();
  const TrialData& trial = study.data.trials[0];
  const auto muscles = values_of(study.truth);
  const InformedForces blind = informed_forces(trial, trial_activation(study, trial), muscles, {.emg_weight = 0.0});
  const InformedForces seeing = informed_forces(trial, trial_activation(study, trial), muscles, {.emg_weight = 10.0});
  for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
    const double flexors = blind.activation.row(i).head(3).maxCoeff();
    EXPECT_LT(std::min(flexors, blind.activation(i, 3)), 1e-6);
  }
  EXPECT_GT(seeing.activation.col(3).minCoeff(), 0.01);
}

TEST(IterateForces, StaysAtTheTruthWhereItBegins) {
  ElbowStudy study = short_study();
  for (std::size_t m = 0; m < study.truth.size(); ++m) study.data.muscles[m].start = study.truth[m];
  for (MuscleSetup& setup : study.data.muscles) setup.priors = literature_priors(setup.start);
  ForceLoopOptions options;
  options.sharing.emg_weight = 1e6;
  options.force.estimator.delay_s = 0.0;
  const ForceLoop loop = iterate_forces(study.data, options);
  EXPECT_EQ(loop.end, LoopEnd::converged) << loop.message;
  for (std::size_t m = 0; m < study.truth.size(); ++m) {
    EXPECT_NEAR(loop.fit.muscles[m].optimal_fiber_length_m / study.truth[m].optimal_fiber_length_m, 1.0, 0.01);
    EXPECT_NEAR(loop.fit.muscles[m].max_isometric_force_n / study.truth[m].max_isometric_force_n, 1.0, 0.01);
  }
}

TEST(IterateForces, ByThePosteriorTheForcesAreSharedWithTheMusclesOfTheTorque) {
  // Two joints: the law, its noise and its muscles are known.
  const ElbowStudy study = test::leg_study({.emg_cv = 0.06, .torque_sd_nm = 1.0});
  ForceLoopOptions options;
  options.force.estimator.estimator = EstimatorKind::posterior;
  options.force.shared_forces = true;
  const ForceLoop loop = iterate_forces(study.data, options);
  EXPECT_EQ(loop.end, LoopEnd::converged) << loop.message;
  ASSERT_EQ(loop.rounds.size(), 1U);
  const IdentificationResult alone = identify_torque(study.data, options.force.estimator);
  EXPECT_EQ(loop.fit.solution, alone.solution);
  ASSERT_EQ(loop.forces.size(), study.data.trials.size());
  double off = 0.0, size = 0.0;
  for (std::size_t t = 0; t < loop.forces.size(); ++t) {
    EXPECT_EQ(loop.forces[t].frames_not_solved, 0);
    off += (loop.forces[t].force_n - study.data.trials[t].force_n).squaredNorm();
    size += study.data.trials[t].force_n.squaredNorm();
  }
  // The start is 20 % off in F_max, and the envelopes err by 6 %.
  EXPECT_LT(std::sqrt(off / size), 0.15);
  EXPECT_LT(loop.rounds[0].reserve_nm, 0.1);
}

TEST(IdentifyForce, ForcesThatAnOptimizerAssignedIdentifyNothing) {
  const StudyData data = short_study().data;
  for (const EstimatorKind kind : {EstimatorKind::least_squares, EstimatorKind::posterior}) {
    ForceOptions options{.shared_forces = true};
    options.estimator.estimator = kind;
    const IdentificationResult found = identify_force(data, options);
    ASSERT_FALSE(found.estimates.empty());
    for (const ParameterEstimate& e : found.estimates) {
      EXPECT_NE(e.verdict, Verdict::identified) << e.muscle << " " << e.parameter;
      EXPECT_NE(e.verdict, Verdict::reproducible) << e.muscle << " " << e.parameter;
    }
  }
}

TEST(IterateForces, EndsWithASentenceAndForcesThatBalance) {
  ForceLoopOptions options;
  options.force.estimator.delay_s = 0.0;
  options.max_rounds = 8;
  const ElbowStudy study = short_study();
  const ForceLoop loop = iterate_forces(study.data, options);
  EXPECT_FALSE(loop.message.empty());
  ASSERT_EQ(loop.forces.size(), study.data.trials.size());
  ASSERT_FALSE(loop.rounds.empty());
  EXPECT_LE(loop.rounds.size(), 8u);
  // It settles: what a round changes becomes less.
  EXPECT_LT(loop.rounds.back().parameter_change, loop.rounds.front().parameter_change);
  for (const InformedForces& forces : loop.forces) EXPECT_EQ(forces.frames_not_solved, 0);
  options.max_rounds = 1;
  EXPECT_EQ(iterate_forces(study.data, options).end, LoopEnd::not_settled);
}

}  // namespace
}  // namespace myoid::identification
