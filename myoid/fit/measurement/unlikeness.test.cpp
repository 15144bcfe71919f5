#include "myoid/fit/measurement/unlikeness.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;

/// A number with the literature's prior of these spreads.
Unknown number_of(const ParameterField& field, double sd, double common_sd = 0.0) {
  Unknown of;
  of.field = &field;
  of.prior = {.mean = 0.1, .sd = sd, .logarithmic = field.logarithmic};
  of.common_sd = common_sd;
  return of;
}

TEST(PriorPrecision, IsOfAPersonsOwnNumberAndEachMusclesOwn) {
  // z_i = mean + c person + own_i, person N(0, 1): the person is integrated over by hand,
  // -2 ln p = sum off_i^2 / v_i - (sum c off_i / v_i)^2 / (1 + sum c^2 / v_i). Strengths and efforts are two such
  // parts.
  const ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true});
  const ParameterMap map(study.data, {});
  const auto field = [&](int of) -> const ParameterField& {
    return *std::find_if(map.free().begin(), map.free().end(), [&](const Unknown& u) {
              return u.is(Scope::muscle, of);
            })->field;
  };
  const double common = 0.4, effort = 0.7;
  const ParameterField& gain = parameter_field("emg_gain");
  std::vector<Unknown> free = {number_of(field(kMaxForce), 0.25, common),
                               number_of(gain, 0.5, effort),
                               number_of(field(kMaxForce), 0.2, common),
                               number_of(field(kMaxForce), 0.9, common),
                               number_of(gain, 0.3, effort),
                               number_of(field(kMaxForce), 0.3),
                               number_of(field(kFiberLength), 0.02),
                               number_of(field(kWidth), 0.01)};
  free[5].prior_is_given = true;
  Eigen::VectorXd off(8);
  off << 0.3, 0.6, -0.1, 0.7, 0.1, 0.2, 0.03, 0.02;
  for (const double unlikeness : {1.0, 1.7}) {
    // A study's prior and a measured spread stay; a judgment is multiplied by lambda.
    double squares = 0.04 / 0.09 + 0.0009 / 0.0004 + 0.0004 / (unlikeness * unlikeness * 0.0001);
    for (const auto& members : {std::vector<std::size_t>{0, 2, 3}, std::vector<std::size_t>{1, 4}}) {
      double along = 0.0, share = 1.0;
      for (const std::size_t i : members) {
        const double own = std::pow(free[i].prior.sd, 2), c = free[i].common_sd;
        const double o = off[static_cast<Eigen::Index>(i)];
        squares += o * o / own;
        along += c * o / own;
        share += c * c / own;
      }
      squares -= along * along / share;
    }
    EXPECT_NEAR(off.dot(prior_precision(free, unlikeness) * off), squares, 1e-9);
  }
  // The precision's inverse has the spreads that are reported.
  const Eigen::MatrixXd covariance = prior_precision(free).inverse();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(std::sqrt(covariance(j, j)), prior_spread(free[i]), 1e-12);
  }
}

/// Five numbers of judged spread 0.1 about 0.1, within these bounds of a spread.
std::vector<Unknown> judged_numbers(double farthest) {
  const ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true});
  static const ParameterMap map(study.data, {});
  const Unknown& width =
      *std::find_if(map.free().begin(), map.free().end(), [](const Unknown& u) { return u.is(Scope::muscle, kWidth); });
  Unknown of = number_of(*width.field, 0.1);
  of.bounds = {0.1 - 0.1 * farthest, 0.1 + 0.1 * farthest};
  return std::vector<Unknown>(5, of);
}

constexpr double kSpread = 0.3;  // of ln lambda

/// Integrates over ln lambda, from -4 to 5 of its spreads.
template <typename Function>
double over_log_lambda(const Function& f) {
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(f, -1.2, 1.5, 8, 1e-12);
}

TEST(CommonStrength, IsTheMeanOfANormalPosteriorAndLeavesTheMusclesTheirOwn) {
  // Three muscles three times as strong as the model's, with own spreads of 0.25 about a person's of 0.38: by Bayes the
  // mean is ln 3 (3 / 0.25^2) / (3 / 0.25^2 + 1 / 0.38^2).
  const ParameterField& field = parameter_field("max_isometric_force");
  std::vector<Unknown> free(4, number_of(field, 0.25, 0.38));
  free[3].common_sd = 0.0;  // known of this person
  const Eigen::VectorXd z = Eigen::VectorXd::Constant(4, 0.1 + std::log(3.0));
  const Strength strength = common_strength(free, z);
  EXPECT_EQ(strength.sd, 0.38);
  EXPECT_NEAR(strength.log_ratio, std::log(3.0) * 48.0 / (48.0 + 1.0 / (0.38 * 0.38)), 1e-12);
  const std::vector<Unknown> own = about_strength(free, strength.log_ratio);
  EXPECT_NEAR(own[0].prior.mean, 0.1 + strength.log_ratio, 1e-12);
  EXPECT_NEAR(own[3].prior.mean, 0.1, 1e-12);
  EXPECT_EQ(common_strength({free[3]}, z).sd, 0.0);
}

TEST(Unlikeness, TheIntegratedPriorIsThatOfAQuadrature) {
  for (const double farthest : {1.5, 50.0}) {
    const Unlikeness unlike(judged_numbers(farthest));
    ASSERT_TRUE(unlike.uncertain());
    EXPECT_NEAR(unlike.judged().sum(), 5.0 / 0.01, 1e-9);
    for (const double squares : {0.0, 3.0, 40.0}) {
      const auto density = [&](double log_lambda) {
        const double lambda = std::exp(log_lambda);
        const double within = std::erf(farthest / lambda / std::sqrt(2.0));
        return std::pow(lambda * within, -5.0) *
               std::exp(-0.5 * squares / (lambda * lambda) - 0.5 * std::pow(log_lambda / kSpread, 2));
      };
      const double sum = over_log_lambda(density);
      const double precision = over_log_lambda([&](double at) { return std::exp(-2.0 * at) * density(at); }) / sum;
      const Unlikeness::Integrated found = unlike.integrated(squares);
      EXPECT_NEAR(found.log_density, std::log(sum), 5e-3) << farthest << " " << squares;
      EXPECT_NEAR(found.precision / precision, 1.0, 5e-3) << farthest << " " << squares;
      const double h = 1e-4;  // the precision is the slope, and must fit the value exactly
      EXPECT_NEAR(-(unlike.integrated(squares + h).log_density - unlike.integrated(squares).log_density) * 2.0 / h,
                  unlike.integrated(squares + 0.5 * h).precision, 1e-7);
    }
  }
}

TEST(Unlikeness, WithoutDataItsSquareIsThePriorsMean) {
  // E[lambda^2] of a log-normal lambda is exp(2 sd^2), whatever the bounds of the numbers are.
  for (const double farthest : {1.5, 50.0})
    EXPECT_NEAR(Unlikeness(judged_numbers(farthest)).expected(Eigen::MatrixXd::Zero(5, 5), Eigen::VectorXd::Zero(5)),
                std::exp(kSpread * kSpread), 1e-3);
}

TEST(Unlikeness, OfNumbersThatAreKnownItIsThatOfTheirSquares) {
  const Eigen::VectorXd off = (Eigen::VectorXd(5) << 0.25, -0.2, 0.1, 0.3, -0.15).finished();
  const double squares = off.squaredNorm() / 0.01, exact = 1e9;
  const auto density = [&](double log_lambda) {
    return std::exp(-5.0 * log_lambda - 0.5 * squares * std::exp(-2.0 * log_lambda) -
                    0.5 * std::pow(log_lambda / kSpread, 2));
  };
  const double square =
      over_log_lambda([&](double at) { return std::exp(2.0 * at) * density(at); }) / over_log_lambda(density);
  EXPECT_GT(square, 1.5);
  EXPECT_NEAR(Unlikeness(judged_numbers(50.0)).expected(exact * Eigen::MatrixXd::Identity(5, 5), (exact + 100.0) * off),
              std::sqrt(square), 2e-3);
}

}  // namespace
}  // namespace myoid::fit
