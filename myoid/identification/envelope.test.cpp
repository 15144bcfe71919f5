#include "myoid/identification/envelope.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

TEST(NoiseGain, IsWhatTheSubtractedNoiseOfTheElectrodeMakesOfTheSpread) {
  // An amplitude m that spreads by 8 %, of a muscle's a in noise of 0.03, and u^2 = m^2 - 0.03^2.
  // 60 000 draws: 0.3 % of a spread; 8 % is not infinitesimal, which bends it by some percent, a
  // tenth where the muscle is as weak as the noise (there the gain is 2).
  constexpr double kRest = 0.03, kSpread = 0.08;
  constexpr Eigen::Index n = 60000;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(n, 0.0, 599.99);
  for (const double a : {0.3, 0.06, 0.03}) {
    Eigen::VectorXd u(n);
    for (double& value : u) {
      const double m = std::hypot(a, kRest) * (1.0 + kSpread * normal(engine));
      value = std::sqrt(std::max(0.0, m * m - kRest * kRest));
    }
    const double spread = std::sqrt((u.array() - u.mean()).square().mean() / u.squaredNorm() *
                                    static_cast<double>(n));
    const double gain = noise_gain(Envelope(time_s, u), 0.0, 600.0, kRest, kSpread);
    EXPECT_NEAR(gain * kSpread / spread, 1.0, 0.1) << a;
    EXPECT_EQ(noise_gain(Envelope(time_s, u), 0.0, 600.0, 0.0, kSpread), 1.0);
  }
}

}  // namespace
}  // namespace myoid::identification
