#include "myoid/fit/posterior/learned_sizes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

TEST(LearnedSizes, AreTheRootMeanSquaresOfTheSamplersDraws) {
  const StudyData data = test::elbow_study({.trials = 3,
                                            .seconds = 8.0,
                                            .emg_cv = 0.1,
                                            .torque_sd_nm = 0.5,
                                            .truth_from_prior = true,
                                            .with_priors = true,
                                            .seed = 3})
                             .data;
  EstimatorOptions options;
  options.choose_lag = false;
  options.posterior_draws = 2400;
  const Exploration sampled = explore(data, options);
  const LearnedSizes found = learned_sizes(sampled.modes.front());
  const Candidate& best = sampled.modes.front();
  const NoiseValues at_mode = best.density->noise_of(best.mode.x);
  double farthest_mode = 0.0;
  for (int field = kModelErrorSize; field < kNoiseFieldCount; ++field) {
    const Eigen::ArrayXd ln_size = sampled.sample.noise.row(field).transpose();
    const double ln_rms = 0.5 * std::log(((2.0 * ln_size).exp() * sampled.sample.weight.array()).sum());
    EXPECT_NEAR(found.noise[field], ln_rms, 0.25) << field << ", at the mode " << at_mode[field];
    farthest_mode = std::max(farthest_mode, std::abs(at_mode[field] - ln_rms));
  }
  EXPECT_GT(farthest_mode, 0.5) << "the joint mode has other sizes";
  EXPECT_EQ(found.noise[kTorqueSd], at_mode[kTorqueSd]);
  EXPECT_GE(found.wider.minCoeff(), 1.0);
}

TEST(Stretch, MovesDrawsAwayFromTheirMeanWithinTheBounds) {
  const StudyData data =
      test::elbow_study({.trials = 2, .seconds = 8.0, .emg_cv = 0.1, .torque_sd_nm = 0.5, .with_priors = true}).data;
  const Density density(data, {});
  const ParameterMap& map = density.parameters();
  const Eigen::VectorXd middle = density.z_of(density.start());
  Sample drawn;
  drawn.weight = Eigen::Vector2d(0.5, 0.5);
  Eigen::VectorXd off(middle.size());
  for (Eigen::Index j = 0; j < off.size(); ++j) {
    const muscle::Range& bounds = map.free()[static_cast<std::size_t>(j)].bounds;
    off[j] = 1e-4 * std::min(middle[j] - bounds.lower, bounds.upper - middle[j]);
  }
  drawn.z.resize(middle.size(), 2);
  drawn.z << middle - off, middle + off;
  stretch(Eigen::VectorXd::Constant(middle.size(), 1.5), map, drawn);
  EXPECT_LT(((drawn.z.col(1) - drawn.z.col(0)) - 3.0 * off).cwiseQuotient(off).cwiseAbs().maxCoeff(), 1e-3);
  stretch(Eigen::VectorXd::Constant(middle.size(), 1e9), map, drawn);
  for (Eigen::Index j = 0; j < off.size(); ++j) {
    const muscle::Range& bounds = map.free()[static_cast<std::size_t>(j)].bounds;
    EXPECT_GE(drawn.z.row(j).minCoeff(), bounds.lower);
    EXPECT_LE(drawn.z.row(j).maxCoeff(), bounds.upper);
  }
}

}  // namespace
}  // namespace myoid::fit
