#include "myoid/fit/posterior/learned_sizes.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

/// A fit of a noisy study, and draws whose sizes scatter by `sd` (of the logarithm) about those of the mode.
struct Fitted {
  explicit Fitted(double sd) {
    test::ElbowStudy study =
        test::elbow_study({.trials = 2, .seconds = 8.0, .emg_cv = 0.1, .torque_sd_nm = 0.5, .with_priors = true});
    EstimatorOptions options;
    options.marginals = false;
    density = std::make_unique<Density>(study.data, options);
    best.density = density.get();
    best.mode.x = density->start();
    const NoiseValues noise = density->noise_of(best.mode.x);
    drawn.of_best = 2;
    drawn.weight = Eigen::Vector2d(0.5, 0.5);
    drawn.noise = noise.replicate(1, 2);
    for (int field = kModelErrorSize; field < kNoiseFieldCount; ++field) {
      drawn.noise(field, 0) -= sd;
      drawn.noise(field, 1) += sd;
    }
  }
  std::unique_ptr<Density> density;
  Candidate best;
  Sample drawn;
};

TEST(LearnedSizes, AreTheRootMeanSquaresOfTheDraws) {
  const Fitted of(0.5);
  const LearnedSizes found = learned_sizes(of.best, of.drawn);
  const NoiseValues at_mode = of.density->noise_of(of.best.mode.x);
  // E[y^2] = y^2 cosh(2 sd) for two draws at either side.
  for (int field = kModelErrorSize; field < kNoiseFieldCount; ++field)
    EXPECT_NEAR(found.noise[field] - at_mode[field], 0.5 * std::log(std::cosh(1.0)), 1e-9);
  EXPECT_EQ(found.noise[kTorqueSd], at_mode[kTorqueSd]);
  EXPECT_GE(found.wider.minCoeff(), 1.0);
  EXPECT_GT(found.wider.maxCoeff(), 1.0);
  EXPECT_LT(found.wider.maxCoeff(), std::sqrt(std::cosh(1.0))) << "only a part of a variance grows with the sizes";
}

TEST(LearnedSizes, ThatAreKnownWidenNothing) {
  const Fitted of(0.0);
  EXPECT_NEAR(learned_sizes(of.best, of.drawn).wider.maxCoeff(), 1.0, 1e-9);
}

TEST(Stretch, MovesDrawsAwayFromTheirMeanWithinTheBounds) {
  Fitted of(0.0);
  const ParameterMap& map = of.density->parameters();
  const Eigen::VectorXd middle = of.density->z_of(of.best.mode.x);
  Eigen::VectorXd off(middle.size());
  for (Eigen::Index j = 0; j < off.size(); ++j) {
    const muscle::Range& bounds = map.free()[static_cast<std::size_t>(j)].bounds;
    off[j] = 1e-4 * std::min(middle[j] - bounds.lower, bounds.upper - middle[j]);
  }
  of.drawn.z.resize(middle.size(), 2);
  of.drawn.z << middle - off, middle + off;
  stretch(Eigen::VectorXd::Constant(middle.size(), 1.5), map, of.drawn);
  EXPECT_LT(((of.drawn.z.col(1) - of.drawn.z.col(0)) - 3.0 * off).cwiseQuotient(off).cwiseAbs().maxCoeff(), 1e-3);
  stretch(Eigen::VectorXd::Constant(middle.size(), 1e9), map, of.drawn);
  for (Eigen::Index j = 0; j < off.size(); ++j) {
    const muscle::Range& bounds = map.free()[static_cast<std::size_t>(j)].bounds;
    EXPECT_GE(of.drawn.z.row(j).minCoeff(), bounds.lower);
    EXPECT_LE(of.drawn.z.row(j).maxCoeff(), bounds.upper);
  }
}

}  // namespace
}  // namespace myoid::fit
