#include "myoid/intervals/reported_interval.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/core/normal.h"

namespace myoid::identification {
namespace {

struct OneNumber {
  OneNumber() {
    number.field = &parameter_field("emg_delay");  // not on a logarithm
    number.bounds.lower = 0.0;
    number.bounds.upper = 0.15;
    intervals.sandwich.newey_west = Eigen::MatrixXd::Constant(1, 1, 1e-6);
    intervals.sandwich.by_noise = Eigen::VectorXd::Zero(1);
  }
  ParameterEstimate reported(double z) const {
    ParameterEstimate e;
    add_routes(e, {.parameter = &number}, intervals, 0, z);
    return e;
  }
  Unknown number;
  Intervals intervals;
};

TEST(ReportedInterval, OfTheSandwichAloneItIsNormal) {
  const ParameterEstimate e = OneNumber().reported(0.06);
  EXPECT_NEAR(*e.ci_low, 0.06 - kNormal95 * 1e-3, 1e-12);
  EXPECT_NEAR(*e.ci_high, 0.06 + kNormal95 * 1e-3, 1e-12);
}

TEST(ReportedInterval, TheFartherOfSandwichAndProfileToEitherSide) {
  OneNumber one;
  one.intervals.profiles = std::vector{Interval{.low = 0.0590, .high = 0.0670}};
  const ParameterEstimate e = one.reported(0.06);
  EXPECT_NEAR(*e.ci_low, 0.06 - kNormal95 * 1e-3, 1e-12);
  EXPECT_NEAR(*e.ci_high, 0.0670, 1e-12);
}

TEST(ReportedInterval, AProfileThatIsOpenReachesTheBound) {
  OneNumber one;
  one.intervals.profiles = std::vector{Interval{.low = 0.0590, .high = {}}};
  EXPECT_NEAR(*one.reported(0.06).ci_high, 0.15, 1e-12);
}

TEST(ReportedInterval, NeverLessThanTrialsShowThatDiffer) {
  OneNumber one;
  one.intervals.sandwich.jackknife = Eigen::MatrixXd::Constant(1, 1, 25e-6);
  EXPECT_NEAR(*one.reported(0.06).ci_high, 0.06 + kNormal95 * 5e-3, 1e-12);
  // The sums over trials, where there are enough of them for that, go before the jackknife.
  one.intervals.sandwich.cluster = Eigen::MatrixXd::Constant(1, 1, 4e-6);
  EXPECT_NEAR(*one.reported(0.06).ci_high, 0.06 + kNormal95 * 2e-3, 1e-12);
}

TEST(ReportedInterval, WhatTheNoiseLevelLeavesOpenComesOnTopAsAVariance) {
  OneNumber one;
  one.intervals.sandwich.by_noise[0] = 2e-3;
  EXPECT_NEAR(*one.reported(0.06).ci_high, 0.06 + kNormal95 * std::sqrt(5.0) * 1e-3, 1e-12);
}

TEST(ReportedInterval, EndsAtTheBoundOfWhatIsPossible) { EXPECT_EQ(*OneNumber().reported(0.001).ci_low, 0.0); }

TEST(ReportedInterval, ANumberOnALogarithmIsReportedInItsUnitWithTheRatioOfATie) {
  OneNumber one;
  one.number.field = &parameter_field("max_isometric_force");
  one.number.bounds.lower = std::log(10.0);
  one.number.bounds.upper = std::log(1e4);
  const RowScale half{.parameter = &one.number, .ratio = 0.5};
  ParameterEstimate e;
  add_routes(e, half, one.intervals, 0, std::log(800.0));
  EXPECT_NEAR(*e.ci_high, 400.0 * std::exp(kNormal95 * 1e-3), 1e-9);
  EXPECT_NEAR(z_of(half, 400.0), std::log(800.0), 1e-12);
}

}  // namespace
}  // namespace myoid::identification
