#include "myoid/fit/posterior/noise_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

double correlation(const EnvelopeError& error, double apart_s) { return error.correlations(apart_s, 1)[1]; }

TEST(EnvelopeError, ItsCorrelationIsThatOfTheSpectrum) {
  const EnvelopeError error(6.0, {0.0, 0.0});
  EXPECT_NEAR(correlation(error, 0.0), 1.0, 1e-12);
  EXPECT_NEAR(error.share(), 1.0, 1e-12);
  // 1 - R is (2 pi f_0 tau)^2 / 2 times the mean of x^2 = (pi / (4 sqrt 2)) / (3 pi / (4 sqrt 2)).
  const double f0 = 6.0 / std::pow(std::sqrt(2.0) - 1.0, 0.25);
  const double tau = 1e-3;
  EXPECT_NEAR(1.0 - correlation(error, tau), 0.5 * std::pow(2.0 * std::numbers::pi * f0 * tau, 2) / 3.0, 2e-5);
  EXPECT_LT(std::abs(correlation(error, 0.99 * error.reach_s())), 1e-4);
  EXPECT_EQ(correlation(error, error.reach_s()), 0.0);
}

TEST(EnvelopeError, LagsTakeVarianceAwayAndJoinNeighbours) {
  const EnvelopeError plain(6.0, {0.0, 0.0}), lagged(6.0, {0.04, 0.03});
  EXPECT_LT(lagged.share(), 0.6);
  EXPECT_GT(lagged.share(), 0.1);
  EXPECT_GT(correlation(lagged, 0.05), correlation(plain, 0.05));
}

TEST(EnvelopeError, WhatAFilterLetsThroughHasItsSpectrum) {
  const EnvelopeError plain(6.0, {0.0, 0.0});
  const Eigen::VectorXd gain = (-plain.frequencies_hz().array() / 2.0).exp();
  const EnvelopeError left = plain.behind(gain);
  EXPECT_NEAR(left.share(), plain.spectrum().dot(gain), 1e-12);
  EXPECT_NEAR(left.spectrum().sum(), 1.0, 1e-12);
  EXPECT_GT(correlation(left, 0.1), correlation(plain, 0.1));
}

TEST(EnvelopeError, WhiteNoiseBehindTheWeightsHasTheAutocorrelation) {
  const EnvelopeError plain(6.0, {0.0, 0.0});
  const Eigen::VectorXd falling = (-plain.frequencies_hz().array() / 2.0).exp();
  for (const EnvelopeError& error : {plain, plain.behind(falling), EnvelopeError(6.0, {0.04, 0.03})}) {
    for (const double interval_s : {0.01, 0.05}) {
      const Eigen::VectorXd h = error.from_white(interval_s);
      ASSERT_EQ(h.size() % 2, 1);
      for (Eigen::Index lag = 0; lag < h.size() / 2; ++lag) {
        const double both = h.head(h.size() - lag).dot(h.tail(h.size() - lag));
        EXPECT_NEAR(both, correlation(error, static_cast<double>(lag) * interval_s), 0.02)
            << lag << " at " << interval_s;
      }
    }
  }
}

/// K of EmgNoise as a dense matrix over n samples, the ends' modulation continued.
Eigen::MatrixXd dense_kernel(const Reduction& reduction, const Eigen::VectorXd& h) {
  const Eigen::Index n = reduction.inputs(), reach = h.size() / 2;
  Eigen::MatrixXd filter = Eigen::MatrixXd::Zero(n, n + 2 * reach);
  for (Eigen::Index i = 0; i < n; ++i) filter.row(i).segment(i, h.size()) = h.transpose();
  return reduction.apply(filter);
}

TEST(EmgNoise, CovarianceAndPullBackAreDenseProducts) {
  const Eigen::Index n = 120;
  const Reduction reduction(n, 20.0, 1.5);
  const Eigen::VectorXd h = EnvelopeError(6.0, {0.0, 0.0}).from_white(0.05);
  const Eigen::Index reach = h.size() / 2;
  const Eigen::MatrixXd k = dense_kernel(reduction, h);
  const EmgNoise noise(reduction, h);
  Eigen::VectorXd variance(n);
  for (Eigen::Index i = 0; i < n; ++i) variance[i] = 1.0 + 0.8 * std::sin(0.11 * static_cast<double>(i));
  Eigen::VectorXd continued(n + 2 * reach);
  for (Eigen::Index i = 0; i < continued.size(); ++i)
    continued[i] = variance[std::clamp<Eigen::Index>(i - reach, 0, n - 1)];
  const Eigen::MatrixXd dense = k * continued.asDiagonal() * k.transpose();
  EXPECT_LT((noise.covariance(variance) - dense).norm(), 1e-12 * dense.norm());

  const Eigen::Index m = reduction.outputs();
  Eigen::MatrixXd by = Eigen::MatrixXd::NullaryExpr(m, m, [](Eigen::Index i, Eigen::Index j) {
    return std::cos(0.7 * static_cast<double>(i + j)) + std::sin(0.3 * static_cast<double>(i * j));
  });
  const Eigen::VectorXd found = noise.pull_back(by);
  const Eigen::VectorXd diagonal = (k.transpose() * by * k).diagonal();
  Eigen::VectorXd folded = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    folded[std::clamp<Eigen::Index>(i - reach, 0, n - 1)] += diagonal[i];
  EXPECT_LT((found - folded).norm(), 1e-12 * folded.norm());
}

TEST(TorqueError, IsTheExponentialBehindTheLowPassAndItsDerivativeThatOfDifferences) {
  const Eigen::Index n = 100;
  const Reduction reduction(n, 20.0, 1.5);
  const Eigen::MatrixXd l = reduction.apply(Eigen::MatrixXd::Identity(n, n));
  Eigen::MatrixXd q(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) q(i, j) = std::exp(-0.05 * std::abs(static_cast<double>(i - j)) / 0.3);
  }
  const Eigen::MatrixXd dense = l * q * l.transpose();
  const TorqueError at = torque_error(reduction, 0.05, std::log(0.3));
  for (Eigen::Index i = 0; i < dense.rows(); ++i) {
    for (Eigen::Index j = 0; j < dense.cols(); ++j) EXPECT_NEAR(dense(i, j), at.correlation[std::abs(i - j)], 1e-12);
  }
  const double h = 1e-5;
  const Eigen::VectorXd difference = (torque_error(reduction, 0.05, std::log(0.3) + h).correlation -
                                      torque_error(reduction, 0.05, std::log(0.3) - h).correlation) /
                                     (2.0 * h);
  EXPECT_LT((difference - at.by_log_time).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace myoid::fit
