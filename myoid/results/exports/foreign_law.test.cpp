#include "myoid/results/exports/foreign_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::results {
namespace {

// A lag answers a step that is held over each interval with 1 - exp(-t / tau) at the ends of the intervals.
TEST(NmsmNeuralActivation, RisesWithItsTimeConstantAndFallsFourTimesAsSlowly) {
  constexpr double kInterval_s = 0.001, kTau_s = 0.01;
  Eigen::VectorXd pulse = Eigen::VectorXd::Zero(1000);
  pulse.segment(100, 400).setOnes();
  const Eigen::VectorXd u = nmsm_neural_activation(pulse, kInterval_s, kTau_s);
  EXPECT_NEAR(u[120], 1.0 - std::exp(-0.02 / kTau_s), 0.03);  // within the first interval the scheme begins
  EXPECT_NEAR(std::log((1.0 - u[130]) / (1.0 - u[110])), -0.02 / kTau_s, 0.02);
  EXPECT_NEAR(std::log(u[600] / u[560]), -0.04 / (4.0 * kTau_s), 2e-3);
  EXPECT_NEAR(u[499], 1.0, 1e-12);
}

TEST(NmsmActivation, IsTheNeuralOneWithoutNonlinearityAndKeepsItsEnds) {
  EXPECT_EQ(nmsm_activation(0.3, 0.0), 0.3);
  for (const double nonlinearity : {0.1, 0.35}) {
    EXPECT_NEAR(nmsm_activation(0.0, nonlinearity), 0.0, 1e-6);
    EXPECT_NEAR(nmsm_activation(1.0, nonlinearity), 1.0, 1e-6);
    EXPECT_GT(nmsm_activation(0.3, nonlinearity), 0.3);
  }
}

// De Groote et al. (2016): f_l(1) = 1 and f_v(0) = 1, f_v(-1) = 0. The passive force at the optimal length is below 1
// %.
TEST(NmsmForce, IsThePublishedCurvesAlongTheTendon) {
  const NmsmMuscle muscle{.max_isometric_force_n = 1000.0,
                          .optimal_fiber_length_m = 0.1,
                          .tendon_slack_length_m = 0.2,
                          .pennation_angle_rad = kPi / 6.0};
  const double along = 0.1 * std::cos(kPi / 6.0);
  EXPECT_NEAR(nmsm_force(1.0, 0.2 + along, 0.0, muscle), 1000.0 * std::cos(kPi / 6.0), 4.0);
  EXPECT_NEAR(nmsm_force(0.5, 0.2 + along, 0.0, muscle) - nmsm_force(0.0, 0.2 + along, 0.0, muscle),
              500.0 * std::cos(kPi / 6.0), 0.5);
  EXPECT_NEAR(nmsm_force(1.0, 0.2 + along, -1.0, muscle) - nmsm_force(0.0, 0.2 + along, 0.0, muscle), 0.0, 1e-9);
  // Far beyond, the passive curve is a line of slope e1 e2.
  const double stiff =
      nmsm_force(0.0, 0.2 + 6.0 * along, 0.0, muscle) - nmsm_force(0.0, 0.2 + 5.0 * along, 0.0, muscle);
  EXPECT_NEAR(stiff, 1000.0 * std::cos(kPi / 6.0) * 0.232000797810576 * 12.438535493526128, 1e-6);
}

}  // namespace
}  // namespace myoid::results
