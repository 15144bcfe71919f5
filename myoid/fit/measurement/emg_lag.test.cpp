#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;

/// A study in which the muscles follow their EMG like this, then with noise: of the EMG 10 %, of
/// the torque 0.3 N m, both below 6 Hz.
StudyData with_lag(EmgLag lag, std::uint64_t seed) {
  constexpr double kRate_hz = 100.0;
  ElbowStudy study = elbow_study({.rate_hz = kRate_hz, .delay_s = 0.08, .with_priors = true, .seed = seed});
  test::StudyNoise noise(seed);
  for (TrialData& trial : study.data.trials) {
    const Eigen::Index n = trial.time_s.size();
    trial.torque_nm =
        predict(study.data, trial, study.truth, study.delay_s, lag).torque_nm + 0.3 * noise.band(n, 6.0, kRate_hz);
    Eigen::MatrixXd recorded = trial.activation.values();
    for (Eigen::Index c = 0; c < recorded.cols(); ++c)
      recorded.col(c).array() *= (1.0 + 0.1 * noise.band(recorded.rows(), 6.0, kRate_hz).array()).max(0.0);
    trial.activation = TimeSeries(trial.activation.time_s(), trial.activation.channels(), std::move(recorded));
  }
  return study.data;
}

TEST(LagShares, AddUpToTheDelayWhereActivityRisesAsOftenAsItFalls) {
  constexpr LagShares kShare;
  EXPECT_NEAR(kShare.pure + kShare.excitation + 0.5 * (kShare.activation + kShare.deactivation), 1.0, 1e-15);
}

TEST(ChooseLag, TheDataTellLagsFromADelay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
      const IdentificationResult result =
          identify_torque(with_lag(lag, seed), {.choose_lag = true, .predictions = false});
      EXPECT_EQ(result.lag, lag) << seed;
      EXPECT_NEAR(result.delay_s, 0.08, 0.008) << seed;
    }
  }
}

TEST(ChooseLag, NothingIsChosenWhereNobodyAsks) {
  const IdentificationResult result = identify_torque(with_lag(EmgLag::shared, 1), {.predictions = false});
  EXPECT_EQ(result.lag, EmgLag::delay);
}

}  // namespace
}  // namespace myoid::fit
