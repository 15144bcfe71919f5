#include "myoid/identification/emg_lag.h"

#include <cstddef>

#include <gtest/gtest.h>

#include "myoid/identification/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

/// A study with noise of EMG and torque, in which the muscles follow their EMG like this.
StudyData with_lag(EmgLag lag, std::uint64_t seed) {
  const auto study = [&](double emg_cv, double torque_sd_nm) {
    return elbow_study({.delay_s = 0.08,
                        .emg_cv = emg_cv,
                        .torque_sd_nm = torque_sd_nm,
                        .with_priors = true,
                        .seed = seed});
  };
  ElbowStudy noisy = study(0.1, 0.3);
  const ElbowStudy clean = study(0.0, 0.0);
  for (std::size_t i = 0; i < noisy.data.trials.size(); ++i) {
    const TrialData& trial = clean.data.trials[i];
    noisy.data.trials[i].torque_nm +=
        predict(clean.data, trial, clean.truth, clean.delay_s, lag).torque_nm -
        predict(clean.data, trial, clean.truth, clean.delay_s).torque_nm;
  }
  return noisy.data;
}

TEST(LagShares, AddUpToTheDelayWhereActivityRisesAsOftenAsItFalls) {
  constexpr LagShares kShare;
  EXPECT_NEAR(kShare.pure + kShare.excitation + 0.5 * (kShare.activation + kShare.deactivation),
              1.0, 1e-15);
}

TEST(ChooseLag, TheDataTellLagsFromADelay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
      const IdentificationResult result =
          identify_torque(with_lag(lag, seed), {.choose_lag = true, .predictions = false});
      EXPECT_EQ(result.lag, lag) << seed;
      ASSERT_TRUE(result.shared_lag_gain);
      EXPECT_EQ(*result.shared_lag_gain > 0.0, lag == EmgLag::shared) << seed;
      EXPECT_NEAR(result.delay_s, 0.08, 0.008) << seed;
    }
  }
}

TEST(ChooseLag, NothingIsChosenWhereNobodyAsks) {
  const IdentificationResult result =
      identify_torque(with_lag(EmgLag::shared, 1), {.predictions = false});
  EXPECT_EQ(result.lag, EmgLag::delay);
  EXPECT_FALSE(result.shared_lag_gain);
}

}  // namespace
}  // namespace myoid::identification
