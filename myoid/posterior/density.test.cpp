#include "myoid/posterior/density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/identification/parameters.h"
#include "myoid/posterior/mode.h"

#include "tests/support/crowded_study.h"
#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::crowded_options;
using test::crowded_study;
using test::elbow_study;
using test::ElbowStudy;

TEST(Density, TheGradientIsThatOfDifferences) {
  const ElbowStudy study = crowded_study();
  for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
    EstimatorOptions options = crowded_options();
    options.lag = lag;
    const Density density(study.data, options);
    Eigen::VectorXd x = density.start();
    for (Eigen::Index j = 0; j < x.size(); ++j)
      x[j] += 0.05 * std::sin(1.0 + 2.0 * static_cast<double>(j));
    Eigen::VectorXd gradient;
    const double value = density.value(x, gradient);
    EXPECT_EQ(value, density.value(x));
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const double h = 2e-4;
      const auto at = [&](double step) {
        return density.value(x + step * Eigen::VectorXd::Unit(x.size(), j));
      };
      const double difference =
          (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
      EXPECT_NEAR(gradient[j], difference, 1e-4 * (1.0 + std::abs(gradient[j]))) << j;
    }
  }
}

/// A muscle's number with the literature's prior of this spread.
Unknown number_of(const ParameterField& field, double sd) {
  Unknown of;
  of.field = &field;
  of.prior = {.mean = 0.1, .sd = sd, .logarithmic = field.logarithmic};
  return of;
}

TEST(PriorPrecision, IsOfAPersonsOwnNumberAndEachMusclesOwn) {
  // z_i = mean + c person + own_i, person N(0, 1): the person is integrated over by hand,
  // -2 ln p = sum off_i^2 / v_i - (sum c off_i / v_i)^2 / (1 + sum c^2 / v_i).
  const ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true});
  const ParameterMap map(study.data, {});
  const auto field = [&](int of) -> const ParameterField& {
    return *std::find_if(map.free().begin(), map.free().end(), [&](const Unknown& u) {
              return u.is(Scope::muscle, of);
            })->field;
  };
  std::vector<Unknown> free = {
      number_of(field(kMaxForce), 0.25),    number_of(field(kMaxForce), 0.2),
      number_of(field(kMaxForce), 0.9),     number_of(field(kMaxForce), 0.3),
      number_of(field(kFiberLength), 0.02), number_of(field(kWidth), 0.01)};
  free[3].prior_is_given = true;
  Eigen::VectorXd off(6);
  off << 0.3, -0.1, 0.7, 0.2, 0.03, 0.02;
  const double common = 0.4;
  const std::array<double, 3> sd = {0.25, 0.2, 0.9};
  for (const double unlikeness : {1.0, 1.7}) {
    // A study's prior and a measured spread stay; a judgment is multiplied by lambda.
    double squares = 0.04 / 0.09 + 0.0009 / 0.0004 + 0.0004 / (unlikeness * unlikeness * 0.0001);
    double along = 0.0, share = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double own = sd[i] * sd[i];
      const double o = off[static_cast<Eigen::Index>(i)];
      squares += o * o / own;
      along += common * o / own;
      share += common * common / own;
    }
    EXPECT_NEAR(off.dot(prior_precision(free, common, unlikeness) * off),
                squares - along * along / share, 1e-9);
  }
  // The precision's inverse has the spreads that are reported.
  const Eigen::MatrixXd covariance = prior_precision(free, common).inverse();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(std::sqrt(covariance(j, j)), prior_spread(free[i], common), 1e-12);
  }
}

TEST(Density, APersonWhoIsUnlikeTheLiteratureWidensItsSpreads) {
  // The same persons, once with the spreads that they were drawn with, once with spreads of 40 %.
  EstimatorOptions every_row;
  every_row.unseen.independent_rows = 0.0;
  double as_drawn = 0.0, unlike = 0.0;
  for (const double believed : {1.0, 0.4}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      ElbowStudy study = elbow_study({.seconds = 10.0,
                                      .emg_cv = 0.05,
                                      .torque_sd_nm = 0.2,
                                      .truth_from_prior = true,
                                      .with_priors = true,
                                      .seed = seed});
      for (MuscleSetup& muscle : study.data.muscles) {
        muscle.fixed = {"tendon_slack_length"};
        for (auto& [name, prior] : muscle.priors) prior.sd *= believed;
      }
      Density density(study.data, every_row);
      EXPECT_EQ(density.unlikeness(), 1.0);
      Eigen::VectorXd x = density.start();
      for (int pass = 0; pass < 3; ++pass) {
        x = find_mode(density, {.x = x}, {}).x;
        density.refer_to(x);
      }
      (believed == 1.0 ? as_drawn : unlike) += density.unlikeness() / 3.0;
    }
  }
  // Some 6 of the 16 numbers of judged spread are told by the data: their spread, 2.5 times the
  // believed one, is known to 30 % a person, and the belief that it is 1 draws it back.
  EXPECT_NEAR(as_drawn, 1.0, 0.25);
  EXPECT_GT(unlike, 1.3);
  EXPECT_LT(unlike, 2.8);
}

// A search's long step, or a belief that the model is nearly exact, goes far into a normal tail.
TEST(Density, ScoresFarOutHaveAFiniteDensity) {
  const ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true});
  EstimatorOptions options;
  for (const double spread : {0.1, 1e-5}) {
    options.unseen.model_error = spread;
    const Density density(study.data, options);
    Eigen::VectorXd x = density.start();
    const Eigen::Index at = density.parameters().size() + kModelErrorSize;
    for (const double score : {-39.0, -9.0, 9.0, 39.0}) {
      x[at] = score;
      EXPECT_TRUE(std::isfinite(density.value(x))) << spread << " " << score;
      EXPECT_GT(std::exp(density.noise_of(x)[kModelErrorSize]), 0.0);
    }
  }
}

TEST(Density, XAndZAreOneAnother) {
  const ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0, .with_priors = true});
  const Density density(study.data, {});
  const Eigen::VectorXd x = density.start();
  const Eigen::VectorXd again = density.x_of(density.z_of(x), density.noise_of(x));
  EXPECT_LT((x - again).cwiseAbs().maxCoeff(), 1e-9);
  for (Eigen::Index j = 0; j < density.parameters().size(); ++j) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(x.size(), j);
    const double slope = (density.z_of(x + step)[j] - density.z_of(x - step)[j]) / 2e-5;
    EXPECT_NEAR(density.slope(x)[j], slope, 1e-7 * std::abs(slope) + 1e-12);
  }
}

}  // namespace
}  // namespace myoid::identification
