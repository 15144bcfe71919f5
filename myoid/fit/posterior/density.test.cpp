#include "myoid/fit/posterior/density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/posterior/mode.h"

#include "tests/support/crowded_study.h"
#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using test::crowded_options;
using test::crowded_study;
using test::elbow_study;
using test::ElbowStudy;

TEST(Density, TheGradientIsThatOfDifferences) {
  const ElbowStudy study = crowded_study();
  for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
    EstimatorOptions options = crowded_options();
    options.law = lag;
    Density density(study.data, options);
    if (lag == EmgLag::shared) density.integrate_unlikeness();
    Eigen::VectorXd x = density.start();
    for (Eigen::Index j = 0; j < x.size(); ++j) x[j] += 0.05 * std::sin(1.0 + 2.0 * static_cast<double>(j));
    Eigen::VectorXd gradient;
    const double value = density.value(x, gradient);
    EXPECT_EQ(value, density.value(x));
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const double h = 2e-4;
      const auto at = [&](double step) { return density.value(x + step * Eigen::VectorXd::Unit(x.size(), j)); };
      const double difference = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
      EXPECT_NEAR(gradient[j], difference, 1e-4 * (1.0 + std::abs(gradient[j]))) << j;
    }
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
}  // namespace myoid::fit
