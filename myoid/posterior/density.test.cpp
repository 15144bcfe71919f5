#include "myoid/posterior/density.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;
using test::freed;

/// Two muscles on one electrode, exponent, gain, offset and an elastic law of length free.
ElbowStudy shared_electrode() {
  ElbowStudy study = elbow_study(
      {.trials = 2, .seconds = 6.0, .emg_cv = 0.08, .torque_sd_nm = 0.4, .with_priors = true});
  study.data.muscles[1].emg_channel = study.data.muscles[0].emg_channel;
  study.data.rules = {freed("emg_exponent"), freed("length_activation"),
                      freed("joint_torque_offset")};
  study.data.rules[0].value = 1.2;
  study.data.rules[1].tie = true;
  study.data.rules[1].value = 0.1;
  return study;
}

TEST(Density, TheGradientIsThatOfDifferences) {
  const ElbowStudy study = shared_electrode();
  for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
    EstimatorOptions options;
    options.angle_sd_rad = 0.01;
    for (const char* channel : {"BIC", "BRD", "TRI"}) {
      options.gain_prior_sd[channel] = 0.1;
      options.emg_bandwidth_hz[channel] = 150.0;
    }
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
