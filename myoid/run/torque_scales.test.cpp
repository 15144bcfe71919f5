#include "myoid/run/torque_scales.h"

#include <gtest/gtest.h>

#include "myoid/fit/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::run {
namespace {

/// A study of four trials; in the last two a dynamometer measures the whole torque, `scale` times the true one.
fit::StudyData measured(double scale) {
  fit::StudyData data =
      test::elbow_study({.trials = 4, .seconds = 12.0, .torque_sd_nm = 0.2, .with_priors = true}).data;
  for (const std::size_t i : {2U, 3U}) {
    data.trials[i].torque_nm *= scale;
    data.trials[i].dynamics_nm.setZero(data.trials[i].time_s.size());
  }
  return data;
}

std::optional<TorqueScales> scales_of(const fit::StudyData& data) {
  const fit::EstimatorOptions options = fit::estimator_options({}, {}, {});
  return torque_scales(data, options, fit::identify_torque(data, options));
}

TEST(TorqueScales, ADynamometerThatShowsMoreThanTheMassesIsFound) {
  const std::optional<TorqueScales> right = scales_of(measured(1.0)), wrong = scales_of(measured(1.15));
  ASSERT_TRUE(right && wrong);
  EXPECT_FALSE(right->differ());
  EXPECT_LT(right->low, 1.0);
  EXPECT_GT(right->high, 1.0);
  EXPECT_TRUE(wrong->differ());
  EXPECT_LT(wrong->low, 1.15);
  EXPECT_GT(wrong->ratio, 1.05);
}

TEST(TorqueScales, AreToldByBothKindsOfTrialsAlone) {
  fit::StudyData data = measured(1.0);
  data.trials.resize(2);
  EXPECT_FALSE(torque_scales(data, {}, {}));
}

}  // namespace
}  // namespace myoid::run
