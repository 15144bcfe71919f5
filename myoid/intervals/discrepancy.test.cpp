#include "myoid/intervals/discrepancy.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

struct Found {
  double relative_size = 0.0;
  double added = 0.0;  ///< Mean variance that the model's error adds, over that of the noise.
};

/// What the electrodes say is the activation to this power.
Found error_of(double power, std::uint64_t seed) {
  ElbowStudy study = elbow_study({.trials = 4,
                                  .seconds = 20.0,
                                  .emg_cv = 0.08,
                                  .torque_sd_nm = 0.3,
                                  .truth_from_prior = true,
                                  .with_priors = true,
                                  .seed = seed});
  for (TrialData& trial : study.data.trials) {
    Eigen::MatrixXd seen = trial.activation.values();
    seen = seen.array().max(0.0).pow(power);
    trial.activation = TimeSeries(trial.activation.time_s(), trial.activation.channels(), std::move(seen));
  }
  // 8 % below 6 Hz are 4 % below 1.5 Hz, what EMG of a bandwidth of 432 Hz has.
  EstimatorOptions options{.starts = 1};
  for (const MuscleSetup& setup : study.data.muscles) options.emg_bandwidth_hz[setup.emg_channel] = 432.0;
  const Estimator estimator(study.data, options);
  const Estimator::Solution solution = estimator.solve(estimator.model().parameters().start());
  const Sandwich parts = sandwich(estimator, solution);
  const Discrepancy error = discrepancy(estimator, solution, parts.model_based);
  return {error.relative_size, (error.covariance.diagonal().array() / parts.model_based.diagonal().array()).mean()};
}

TEST(Discrepancy, IsSmallWhereTheModelIsRightAndSeenWhereTheEmgIsNotLinear) {
  double right = 0.0, wrong = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Found good = error_of(1.0, seed);
    const Found bad = error_of(0.5, seed);
    EXPECT_LT(good.relative_size, 0.5 * bad.relative_size) << seed;
    EXPECT_GT(bad.added, good.added) << seed;
    right += good.relative_size / 3.0;
    wrong += bad.relative_size / 3.0;
  }
  // Activations of 0.05 to 0.5 then read 0.22 to 0.7: against one gain that is off by a third to
  // either side, of which lengths and speeds take up a part.
  EXPECT_LT(right, 0.05);
  EXPECT_GT(wrong, 0.10);
}

TEST(Discrepancy, AnIntervalHoldsItsShareOfAllSizesTogether) {
  Discrepancy error;
  error.by_muscle = Eigen::VectorXd::Constant(1, 9.0);
  error.by_joint = Eigen::VectorXd::Constant(1, 4.0);
  // One size alone: a normal error of variance 1 + 9 (1/3)^2 + 4 = 6.
  error.posterior = {{1.0 / 3.0, 1.0, 1.0}};
  EXPECT_NEAR(error.reach(0, 1.0, 0.95), 1.959964 * std::sqrt(6.0), 1e-5);
  // None in three cases of four, else ten times the noise: few errors come from there, most of the variance does.
  error.posterior = {{0.0, 0.0, 0.75}, {10.0 / 3.0, 0.0, 0.25}};
  const double reach = error.reach(0, 1.0, 0.95);
  const double inside = 0.75 * std::erf(reach / std::sqrt(2.0)) + 0.25 * std::erf(reach / std::sqrt(2.0 * 101.0));
  EXPECT_NEAR(inside, 0.95, 1e-9);
  EXPECT_NEAR(error.reach(0, 0.0, 0.7), 0.0, 1e-9);  // three in four have no error at all
}

TEST(Discrepancy, AParameterOnItsBoundIsNoErrorOfTheModel) {
  // No delay at all: the estimate lies on its bound, and what a negative delay would explain stays in the residual.
  const ElbowStudy study = elbow_study({.trials = 4,
                                        .seconds = 15.0,
                                        .delay_s = 0.0,
                                        .torque_sd_nm = 0.02,
                                        .truth_from_prior = true,
                                        .with_priors = true,
                                        .seed = 2});
  int on_bound = 0;
  for (const double lead_s : {0.0, 0.004}) {
    StudyData data = study.data;
    for (TrialData& trial : data.trials) {
      const Eigen::VectorXd clock = trial.activation.time_s().array() + lead_s;
      trial.activation = TimeSeries(clock, trial.activation.channels(), trial.activation.values());
    }
    const Estimator estimator(data, {.starts = 1});
    const Estimator::Solution solution = estimator.solve(estimator.model().parameters().start());
    for (std::size_t j = 0; j < estimator.free().size(); ++j) {
      if (estimator.free()[j].field->scope == Scope::channel && estimator.free()[j].field->name == "emg_delay")
        on_bound += solution.search.x[static_cast<Eigen::Index>(j)] < 1e-6 ? 1 : 0;
    }
    const Sandwich parts = sandwich(estimator, solution);
    EXPECT_LT(discrepancy(estimator, solution, parts.model_based).relative_size, 0.05) << lead_s;
  }
  EXPECT_GT(on_bound, 0);
}

}  // namespace
}  // namespace myoid::identification
