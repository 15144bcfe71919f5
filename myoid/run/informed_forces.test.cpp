#include "myoid/run/informed_forces.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/muscle_activation.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/error.h"

#include "tests/support/elbow_study.h"
#include "tests/support/leg_study.h"

namespace myoid::run {
namespace {

using test::elbow_study;
using test::ElbowStudy;

template <class Muscles>
std::vector<fit::MuscleValues> values_of(const Muscles& muscles) {
  std::vector<fit::MuscleValues> values;
  for (const auto& hill : muscles) values.push_back(fit::muscle_values(hill));
  return values;
}

Eigen::MatrixXd trial_activation(const ElbowStudy& study, const fit::TrialData& trial) {
  return fit::muscle_activation(study.data, trial, study.delay_s);
}

ElbowStudy short_study() {
  return elbow_study({.trials = 2, .seconds = 8.0, .rate_hz = 50.0, .delay_s = 0.0, .with_priors = true});
}

TEST(InformedForces, WithTheTrueMusclesTheTrueForcesNeedNoReserve) {
  const ElbowStudy study = short_study();
  for (const fit::TrialData& trial : study.data.trials) {
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
  const fit::TrialData& trial = study.data.trials[0];
  for (const double weight : {0.0, 1.0, 100.0}) {
    const InformedForces found =
        informed_forces(trial, trial_activation(study, trial), values_of(body::arm4_muscles()), {.emg_weight = weight});
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
  const fit::TrialData& trial = study.data.trials[0];
  const auto muscles = values_of(study.truth);
  const InformedForces blind = informed_forces(trial, trial_activation(study, trial), muscles, {.emg_weight = 0.0});
  const InformedForces seeing = informed_forces(trial, trial_activation(study, trial), muscles, {.emg_weight = 10.0});
  for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
    const double flexors = blind.activation.row(i).head(3).maxCoeff();
    EXPECT_LT(std::min(flexors, blind.activation(i, 3)), 1e-6);
  }
  EXPECT_GT(seeing.activation.col(3).minCoeff(), 0.01);
}

TEST(InformedForces, TheMusclesOfTheTorqueShareForcesNearTheTrueOnes) {
  const ElbowStudy study = test::leg_study({.emg_cv = 0.06, .torque_sd_nm = 1.0});
  const fit::IdentificationResult found_fit = fit::identify_torque(study.data, {.predictions = false});
  double off = 0.0, size = 0.0, reserve = 0.0, samples = 0.0;
  for (const fit::TrialData& trial : study.data.trials) {
    const InformedForces found =
        informed_forces(trial, fit::muscle_activation(study.data, trial, found_fit.delay_s), found_fit.values.muscles);
    EXPECT_EQ(found.frames_not_solved, 0);
    off += (found.force_n - trial.force_n).squaredNorm();
    size += trial.force_n.squaredNorm();
    reserve += found.reserve_nm.squaredNorm();
    samples += static_cast<double>(found.reserve_nm.size());
  }
  // The start is 20 % off in F_max, and the envelopes err by 6 %.
  EXPECT_LT(std::sqrt(off / size), 0.15);
  EXPECT_LT(std::sqrt(reserve / samples), 0.1);
}

}  // namespace
}  // namespace myoid::run
