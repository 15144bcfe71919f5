#include "myoid/fit/posterior/voluntary_states.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

TEST(PeaksOf, AParabolaHasItsOwnPeakBetweenSamples) {
  const Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(21, 0.0, 2.0);
  const NormalTorque torque{40.0 - 10.0 * (place.array() - 1.03).square(), Eigen::MatrixXd::Zero(21, 1)};
  const Peaks peaks = peaks_of(torque, place, voluntary_draws(21));
  EXPECT_NEAR(peaks.value, 40.0, 1e-9);
  EXPECT_NEAR(peaks.place, 1.03, 1e-9);
  EXPECT_FALSE(peaks.at_end);
  EXPECT_NEAR((peaks.values.array() - 40.0).abs().maxCoeff(), 0.0, 1e-9);
  EXPECT_EQ(peaks.at_ends, 0.0);
}

TEST(PeaksOf, ACommonFactorMovesTheValueAndNotThePlace) {
  const Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(21, 0.0, 2.0);
  const Eigen::VectorXd mean = 40.0 - 10.0 * (place.array() - 1.03).square();
  const Peaks peaks = peaks_of({mean, 0.1 * mean}, place, voluntary_draws(21));
  EXPECT_NEAR((peaks.places.array() - 1.03).abs().maxCoeff(), 0.0, 1e-6);
  const Eigen::ArrayXd log_ratio = (peaks.values.array() / 40.0).log();
  EXPECT_NEAR(log_ratio.mean(), 0.0, 1e-9);  // draws have mirror images
  EXPECT_NEAR(std::sqrt(log_ratio.square().mean()), 0.1, 0.01);
}

TEST(PeaksOf, ATiltMovesThePlaceByTheSlopeOverTheBend) {
  const Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(41, 0.0, 2.0);
  const NormalTorque torque{40.0 - 10.0 * (place.array() - 1.0).square(), (place.array() - 1.0).matrix()};
  const Peaks peaks = peaks_of(torque, place, voluntary_draws(41));
  // Tilt e: the maximum of -10 x^2 + e x is at x = e / 20.
  EXPECT_NEAR(std::sqrt((peaks.places.array() - 1.0).square().mean()), 1.0 / 20.0, 0.005);
}

TEST(PeaksOf, ARisingCurveIsGreatestAtItsEnd) {
  const Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(11, 0.0, 1.0);
  const Peaks peaks = peaks_of({place, Eigen::MatrixXd::Zero(11, 1)}, place, voluntary_draws(11));
  EXPECT_TRUE(peaks.at_end);
  EXPECT_EQ(peaks.place, 1.0);
  EXPECT_NEAR(peaks.at_ends, 1.0, 1e-9);
}

}  // namespace
}  // namespace myoid::fit
