#include "myoid/body/forces/force_sharing.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/body/forces/optimality.h"
#include "myoid/body/forces/sharing_objective.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

constexpr double kSmallReserve_nm = 1e-4;  // makes the reserve's part negligible: its share is (T / sum)^2

SharingProblem elbow(double torque_nm) {
  SharingProblem p;
  p.moment_arm.resize(1, 4);
  p.moment_arm << 0.045, 0.028, 0.06, -0.021;
  p.optimal_force.resize(4);
  p.optimal_force << 900.0, 800.0, 250.0, 1800.0;
  p.torque = Eigen::VectorXd::Constant(1, torque_nm);
  p.lower = Eigen::VectorXd::Zero(4);
  p.upper = Eigen::VectorXd::Ones(4);
  p.reserve = Eigen::VectorXd::Constant(1, kSmallReserve_nm);
  return p;
}

TEST(ForceSharing, SharesAsTheClosedFormForOneJointSays) {
  // min sum x^2: x_i = T r_i F_i / sum_j (r_j F_j)^2 over the agonists, antagonists exactly 0.
  const SharingProblem p = elbow(20.0);
  const SharingSolution s = solve_sharing(p);
  const Eigen::VectorXd a = p.moment_arm.row(0).transpose().cwiseProduct(p.optimal_force);
  const double sum = a.head(3).squaredNorm();
  for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(s.activation[i], 20.0 * a[i] / sum, 1e-11);
  EXPECT_EQ(s.activation[3], 0.0);
  EXPECT_LT(s.kkt_residual, 1e-9);
}

TEST(ForceSharing, CubesShareAsTheSquareRootOfTheirStrength) {
  // p = 3: 3 x_i^2 = lambda a_i, so x_i is proportional to sqrt(a_i).
  SharingProblem p = elbow(20.0);
  p.exponent = 3.0;
  const SharingSolution s = solve_sharing(p);
  const Eigen::VectorXd a = p.moment_arm.row(0).transpose().cwiseProduct(p.optimal_force);
  EXPECT_NEAR(s.activation[0] / s.activation[1], std::sqrt(a[0] / a[1]), 1e-9);
  EXPECT_NEAR(a.dot(s.activation), 20.0, 1e-6);
  EXPECT_LT(s.kkt_residual, 1e-9);
}

TEST(ForceSharing, AMuscleAtItsLimitLeavesTheRestToTheOthers) {
  SharingProblem p = elbow(50.0);
  p.upper[0] = 0.5;
  const SharingSolution s = solve_sharing(p);
  EXPECT_EQ(s.activation[0], 0.5);
  EXPECT_NEAR(p.moment_arm.row(0).dot(p.optimal_force.cwiseProduct(s.activation)), 50.0, 1e-5);
  EXPECT_LT(s.kkt_residual, 1e-9);
}

TEST(ForceSharing, WhatTheMusclesCannotDoTheReserveDoes) {
  SharingProblem p = elbow(500.0);
  p.reserve[0] = 10.0;
  const SharingSolution s = solve_sharing(p);
  EXPECT_EQ(s.activation[0], 1.0);
  EXPECT_NEAR(s.reserve_torque[0], 500.0 - 0.045 * 900.0 - 0.028 * 800.0 - 0.06 * 250.0, 1e-8);
}

TEST(ForceSharing, PermutingMusclesPermutesTheAnswer) {
  const SharingProblem p = elbow(15.0);
  SharingProblem q = p;
  const Eigen::Vector4i order(2, 0, 3, 1);
  for (Eigen::Index i = 0; i < 4; ++i) {
    q.moment_arm(0, i) = p.moment_arm(0, order[i]);
    q.optimal_force[i] = p.optimal_force[order[i]];
  }
  const SharingSolution a = solve_sharing(p);
  const SharingSolution b = solve_sharing(q);
  for (Eigen::Index i = 0; i < 4; ++i) EXPECT_NEAR(b.activation[i], a.activation[order[i]], 1e-14);
}

TEST(ForceSharing, AStrongEmgTermFollowsTheEmgIntoCoContraction) {
  SharingProblem p = elbow(10.0);
  p.reserve[0] = 100.0;
  p.emg = Eigen::Vector4d(0.3, 0.3, 0.2, 0.25);
  p.emg_weight = 1e9;
  EXPECT_LT((solve_sharing(p).activation - p.emg).cwiseAbs().maxCoeff(), 1e-6);
}

/// Independent: projected gradient on the primal with the reserve eliminated. Slow and simple.
Eigen::VectorXd by_projected_gradient(const SharingProblem& p) {
  const Eigen::MatrixXd a = p.moment_arm * p.optimal_force.asDiagonal();
  Eigen::VectorXd x = p.lower;
  const Eigen::MatrixXd scaled = p.reserve.cwiseInverse().asDiagonal() * a;
  const double lipschitz = 2.0 + 2.0 * scaled.squaredNorm();
  Eigen::VectorXd y = x;
  double t = 1.0;
  for (int i = 0; i < 200000; ++i) {
    const Eigen::VectorXd gradient =
        2.0 * y + 2.0 * scaled.transpose() * (scaled * y - p.torque.cwiseQuotient(p.reserve));
    const Eigen::VectorXd next = (y - gradient / lipschitz).cwiseMax(p.lower).cwiseMin(p.upper);
    const double t_next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    y = next + (t - 1.0) / t_next * (next - x);
    x = next;
    t = t_next;
  }
  return x;
}

TEST(ForceSharing, AgreesWithProjectedGradientsOnRandomProblems) {
  std::mt19937_64 engine(5);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1.0p-53; };
  for (int trial = 0; trial < 4; ++trial) {
    SharingProblem p;
    p.moment_arm.resize(3, 12);
    for (double& r : p.moment_arm.reshaped()) r = 0.1 * (uniform() - 0.5);
    p.optimal_force.resize(12);
    for (double& f : p.optimal_force) f = 200.0 + 800.0 * uniform();
    p.torque = 60.0 * Eigen::Vector3d(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5);
    p.lower = Eigen::VectorXd::Constant(12, 0.01);
    p.upper = Eigen::VectorXd::Constant(12, 0.6);
    p.reserve = Eigen::Vector3d(5.0, 5.0, 5.0);
    const SharingSolution s = solve_sharing(p);
    EXPECT_LT(s.kkt_residual, 1e-9);
    EXPECT_LT((s.activation - by_projected_gradient(p)).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(KktResidual, SeesAWrongSolution) {
  const SharingProblem p = elbow(20.0);
  SharingSolution s = solve_sharing(p);
  s.activation[0] += 0.01;
  s.activation[1] -= 0.01;
  EXPECT_GT(kkt_residual(p, s), 1e-3);
}

TEST(ForceSharing, ANumberThatIsNoneGivesAStatusNotACrash) {
  EXPECT_EQ(solve_sharing(elbow(std::nan(""))).status, SharingStatus::not_finite);
}

TEST(ForceSharing, RefusesAnExponentOfOne) {
  SharingProblem p = elbow(1.0);
  p.exponent = 1.0;
  EXPECT_THROW((void)solve_sharing(p), InvalidInput);
}

// F(x) = c (x + b x^2) + d: the optimum of one joint is x with p x^(p-1) = lambda r F'(x), found
// here by two nested bisections.
TEST(ForceSharing, LawsThatBendAreSharedAsBisectionSharesThem) {
  SharingProblem p = elbow(20.0);
  p.exponent = 3.0;
  const double bend[] = {0.4, -0.3, 0.8, 0.1}, rest[] = {30.0, 0.0, 5.0, 40.0};
  const auto law = [&](Eigen::Index i, double x) {
    const double c = p.optimal_force[i];
    return ForceAtActivation{c * (x + bend[i] * x * x) + rest[i], c * (1.0 + 2.0 * bend[i] * x)};
  };
  const auto activation = [&](Eigen::Index i, double lambda) {
    const double arm = p.moment_arm(0, i);
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 200; ++k) {
      const double x = 0.5 * (low + high);
      (3.0 * x * x < lambda * arm * law(i, x).slope_n ? low : high) = x;
    }
    return 0.5 * (low + high);
  };
  const auto torque = [&](double lambda) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < 4; ++i) sum += p.moment_arm(0, i) * law(i, activation(i, lambda)).force_n;
    return sum;
  };
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 200; ++k) {
    const double lambda = 0.5 * (low + high);
    (torque(lambda) < 20.0 ? low : high) = lambda;
  }
  const SharingSolution s = solve_sharing(p, law, Eigen::VectorXd::Constant(4, 0.3));
  EXPECT_EQ(s.status, SharingStatus::optimal);
  // The reserve of 1e-4 N m takes its small part, (T^1.5 / sum)^... below 1e-6 of the torque.
  for (Eigen::Index i = 0; i < 4; ++i) EXPECT_NEAR(s.activation[i], activation(i, low), 1e-6) << i;
  double sum = s.reserve_torque[0];
  for (Eigen::Index i = 0; i < 4; ++i) sum += p.moment_arm(0, i) * law(i, s.activation[i]).force_n;
  EXPECT_NEAR(sum, 20.0, 1e-10);
}

TEST(ForceSharing, AStraightLawWithARestIsTheProblemWithTheRestTakenOff) {
  const SharingProblem p = elbow(20.0);
  const auto law = [&](Eigen::Index i, double x) {
    return ForceAtActivation{p.optimal_force[i] * x + 10.0, p.optimal_force[i]};
  };
  SharingProblem less = p;
  less.torque[0] -= 10.0 * p.moment_arm.sum();
  const SharingSolution expected = solve_sharing(less);
  const SharingSolution s = solve_sharing(p, law, Eigen::VectorXd::Zero(4));
  EXPECT_LT((s.activation - expected.activation).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace myoid::body
