#include "myoid/intervals/product_estimate.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

struct Muscle {
  Muscle() {
    for (const char* name : {"concentric_curvature", "eccentric_plateau", "eccentric_slope_ratio"}) {
      Unknown f;
      f.field = &parameter_field(name);
      free.push_back(f);
    }
    z << std::log(0.3), 1.5, std::log(2.0);
    e.estimate = 0.5 * 0.3 / (2.0 * 1.3);  // P = (V_ml - 1) V_sh / (S (1 + V_sh))
  }
  std::vector<Unknown> free;
  Eigen::Vector3d z;
  ParameterEstimate e;
};
constexpr ProductPositions kAll{.curvature = 0, .plateau = 1, .ratio = 2};

TEST(ProductEstimate, SmallErrorsPropagateThroughTheDerivativesOfP) {
  // d ln P = d ln V_sh / (1 + V_sh) + d V_ml / (V_ml - 1) - d ln S
  Muscle m;
  Eigen::Matrix3d covariance;
  covariance << 4e-4, 1e-4, 0.0, 1e-4, 1e-4, 0.0, 0.0, 0.0, 9e-4;
  const Eigen::Vector3d slope(1.0 / 1.3, 2.0, -1.0);
  const double sd = std::sqrt(slope.dot(covariance * slope));
  add_product_interval(m.e, kAll, m.free, m.z, covariance, nullptr);
  // 2000 quasi-random draws: quantiles to some 2 %.
  EXPECT_NEAR(*m.e.std_error / m.e.estimate, sd, 0.03 * sd);
  EXPECT_NEAR(std::log(*m.e.ci_high / m.e.estimate), 1.96 * sd, 0.05 * 1.96 * sd);
  EXPECT_NEAR(std::log(m.e.estimate / *m.e.ci_low), 1.96 * sd, 0.05 * 1.96 * sd);
}

TEST(ProductEstimate, ItsPriorIsThatOfTheThree) {
  Muscle m;
  for (int i = 0; i < 3; ++i) {
    m.free[static_cast<std::size_t>(i)].prior.mean = m.z[i];
    m.free[static_cast<std::size_t>(i)].prior.sd = 0.01;
  }
  add_product_interval(m.e, kAll, m.free, m.z, 0.25e-4 * Eigen::Matrix3d::Identity(), nullptr);
  EXPECT_NEAR(*m.e.prior_mean, m.e.estimate, 1e-12);
  EXPECT_NEAR(*m.e.shrinkage, 0.75, 0.02);  // half the spread each: a quarter of the variance
}

TEST(ProductEstimate, NothingWhereOneOfTheThreeIsNoUnknown) {
  Muscle m;
  add_product_interval(m.e, {.curvature = 0, .plateau = -1, .ratio = 2}, m.free, m.z, Eigen::Matrix3d::Identity(),
                       nullptr);
  EXPECT_FALSE(m.e.ci_low);
  EXPECT_TRUE(m.e.routes.empty());
}

}  // namespace
}  // namespace myoid::identification
