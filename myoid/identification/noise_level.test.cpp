#include "myoid/identification/noise_level.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

/// Squares of normal residuals of variance `torque` + `emg` power, the power from 0 to 2.
struct Squares {
  Eigen::ArrayXd squared, power;
};

Squares squares(double torque, double emg) {
  constexpr Eigen::Index n = 20000;
  Squares s{Eigen::ArrayXd(n), Eigen::ArrayXd(n)};
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < n; ++i) {
    s.power[i] = 2.0 * static_cast<double>(i) / n;
    s.squared[i] = (torque + emg * s.power[i]) * std::pow(normal(engine), 2);
  }
  return s;
}

TEST(NoiseLevel, BothVariancesAreThoseOfTheResiduals) {
  // 20 000 samples: a variance to some 3 %.
  const Squares s = squares(0.25, 1.0);
  const NoiseLevel known = fit_known_noise(s.squared, s.power, 1.0);
  EXPECT_NEAR(known.torque_sd_nm, 0.5, 0.02);
  EXPECT_NEAR(known.emg_factor, 1.0, 0.03);
  const NoiseLevel unknown = fit_unknown_noise(squares(0.25, 0.04).squared, s.power);
  EXPECT_NEAR(unknown.torque_sd_nm, 0.5, 0.02);
  EXPECT_NEAR(unknown.emg_factor, 0.2, 0.02);
  EXPECT_EQ(unknown.emg_share, 1.0);
}

TEST(NoiseLevel, OfWhatGoesWithTheMusclesNoMoreIsTheEmgsThanIsExpected) {
  const Squares s = squares(0.25, 4.0);
  const NoiseLevel much = fit_known_noise(s.squared, s.power, 1.0);
  EXPECT_NEAR(much.emg_factor, 2.0, 0.06);
  EXPECT_NEAR(much.emg_share * much.emg_factor * much.emg_factor, 1.0, 1e-12);
  EXPECT_NEAR(much.log_variance_sd, 0.6, 1e-12);  // as uncertain as beforehand
  const NoiseLevel little = fit_known_noise(0.1 * s.power, s.power, 1.0);
  EXPECT_EQ(little.emg_share, 1.0);
}

}  // namespace
}  // namespace myoid::identification
