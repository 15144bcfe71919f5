#include "myoid/results/exports/foreign_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::results {
namespace {

// A lag answers a step that is held over each interval with 1 - exp(-t / tau) at the ends of the intervals.
TEST(RecursiveActivation, AnswersAStepAsALagDoes) {
  constexpr double kInterval_s = 0.01, kTau_s = 0.05;
  Eigen::VectorXd step = Eigen::VectorXd::Ones(200);
  step.head(50).setZero();
  const double c = -std::exp(-kInterval_s / kTau_s);
  const Eigen::VectorXd one = recursive_activation(step, c, 0.0);
  for (int k = 0; k < 150; ++k) EXPECT_NEAR(one[50 + k], 1.0 - std::exp(-(k + 1) * kInterval_s / kTau_s), 1e-13);
  EXPECT_EQ(one.head(50).cwiseAbs().maxCoeff(), 0.0);
  // Two lags are one after the other, in any order.
  const double other = -std::exp(-kInterval_s / 0.02);
  const Eigen::VectorXd chain = recursive_activation(one, other, 0.0);
  EXPECT_LT((recursive_activation(step, c, other) - chain).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(recursive_activation(step, 0.0, 0.0), step);
}

TEST(ExponentialShape, RunsFromZeroToOneAndBendsByItsFactor) {
  for (const double factor : {-3.0, -1e-5, 0.0, 2.0}) {
    EXPECT_EQ(exponential_shape(0.0, factor), 0.0);
    EXPECT_NEAR(exponential_shape(1.0, factor), 1.0, 1e-15);
  }
  EXPECT_NEAR(exponential_shape(0.5, -2.0), (1.0 - std::exp(-1.0)) / (1.0 - std::exp(-2.0)), 1e-15);
  EXPECT_NEAR(exponential_shape(0.5, -1e-5), 0.5, 2e-6);
}

// At full excitation du/dt = (1 - u) / tau, at none -u / (4 tau). The scheme is of second order: (T / tau)^2 / 3 is
// 3e-3.
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
