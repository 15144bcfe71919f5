#include "myoid/results/realtime/predictor.h"

#include <atomic>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/envelope.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/muscle/hill_muscle.h"

namespace {
std::atomic<long> allocations{0};
}  // namespace

// Counts every allocation of this executable; a sanitizer has a malloc of its own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace myoid::results {
namespace {

using namespace fit;

/// A path with l(q) = l0 - r q for q in 0..2.
body::PathSurrogate straight(double length_m, double arm_m) {
  body::PathSurrogate path;
  path.coordinates = {0};
  path.lower = Eigen::VectorXd::Zero(1);
  path.upper = Eigen::VectorXd::Constant(1, 2.0);
  path.degree = 1;
  path.coefficient_m = Eigen::Vector2d(length_m - arm_m, -arm_m);  // T_0 and T_1 of x = q - 1
  return path;
}

muscle::HillParameters<double> flexor() {
  return {.max_isometric_force_n = 800.0,
          .optimal_fiber_length_m = 0.12,
          .force_length_width_m = 0.05,
          .concentric_curvature = 0.3,
          .eccentric_curvature_product = 0.06,
          .eccentric_plateau = 1.4,
          .max_shortening_speed_mps = 1.2,
          .tendon_slack_length_m = 0.18};
}

muscle::HillParameters<double> extensor() {
  muscle::HillParameters<double> hill = flexor();
  hill.max_isometric_force_n = 1500.0;
  return hill;
}

/// A flexor with two heads and an extensor at one hinge; six unknowns that are correlated.
Predictor elbow() {
  Predictor p;
  p.paths = {straight(0.31, 0.03), straight(0.33, 0.05), straight(0.29, -0.02)};
  p.muscles = {{"F", 0, muscle_values(flexor()), {{0, 0.25}, {1, 0.75}}, {}},
               {"E", 1, muscle_values(extensor()), {{2, 1.0}}, {}}};
  p.channels = {{"f", {0.05, 0.9, 0.0, 0.04, 0.015, 0.05, 1.0}, {}},
                {"e", {0.05, 1.0, -1.5, 0.04, 0.015, 0.05, 0.8}, {}}};
  p.joints = {{"elbow", 0, {0.4, 0.0, 1.5, -0.3}, {}}};
  p.muscles[0].chains = {{kMaxForce, 0, 800.0}, {kFiberLength, 1, 1.0}};
  p.muscles[1].chains = {{kMaxForce, 2, 1500.0}, {kFiberLength, 1, 0.9}};
  p.channels[0].chains = {{kGain, 3, 0.9}};
  p.channels[1].chains = {{kExponent, 4, 1.0}};
  p.joints[0].chains = {{kStiffness, 5, 1.0}};
  p.default_q = Eigen::VectorXd::Zero(1);
  const Eigen::MatrixXd root = Eigen::MatrixXd::Identity(6, 6) + 0.3 * Eigen::MatrixXd::Ones(6, 6);
  const Eigen::VectorXd sd = (Eigen::VectorXd(6) << 0.1, 0.004, 0.2, 0.05, 0.1, 0.3).finished();
  p.covariance = sd.asDiagonal() * root * root.transpose() * sd.asDiagonal();
  p.torque_sd_nm = 0.7;
  return p;
}

struct Input {
  std::vector<double> envelope{0.3, 0.2}, angle{1.1}, speed{-0.8};
};

PredictorWorkspace predicted(const Predictor& p, const Input& in = {}) {
  PredictorWorkspace w = workspace_for(p);
  EXPECT_EQ(predict(p, in.envelope, in.angle, in.speed, w), Prediction::done);
  return w;
}

TEST(Predictor, HasTheForcesOfHillsMuscleAndTheTorqueOfTheirMomentArms) {
  const Predictor p = elbow();
  const PredictorWorkspace w = predicted(p);
  const double q = 1.1, speed = -0.8;
  // Heads weighted: r = 0.25 * 0.03 + 0.75 * 0.05, l the same mean.
  const double arm_f = 0.045, length_f = 0.325 - arm_f * q, arm_e = -0.02, length_e = 0.29 - arm_e * q;
  const double a_f = 0.9 * 0.3;
  const double u = std::pow(0.2, 0.8), a_e = std::expm1(-1.5 * u) / std::expm1(-1.5);
  const double force_f = muscle::hill_force(a_f, length_f - 0.18, -arm_f * speed, flexor());
  const double force_e = muscle::hill_force(a_e, length_e - 0.18, -arm_e * speed, extensor());
  EXPECT_NEAR(w.force_n[0], force_f, 1e-9 * force_f);
  EXPECT_NEAR(w.force_n[1], force_e, 1e-9 * force_e);
  EXPECT_NEAR(w.torque_nm[0], arm_f * force_f + arm_e * force_e - 0.4 * speed - 1.5 * q - 0.3, 1e-10);
}

/// A leg of two joints, whose muscles cross one or both and share some unknowns: `own` unknowns of
/// each muscle are its own, the others serve several.
Predictor leg(int muscles, int own, int shared) {
  Predictor p;
  const int unknowns = muscles * own + shared;
  for (int m = 0; m < muscles; ++m) {
    body::PathSurrogate path = straight(0.31, 0.02 + 0.01 * (m % 3));
    path.coordinates = {m % 2};
    if (m % 3 == 0) {
      path.coordinates = {0, 1};
      path.lower = Eigen::Vector2d(0.0, -1.0);
      path.upper = Eigen::Vector2d(2.0, 1.0);
      path.coefficient_m = Eigen::Vector3d(0.29, -0.03, 0.02);
    }
    p.paths.push_back(path);
    const auto k = static_cast<std::size_t>(m);
    p.muscles.push_back({"m", k % 2, muscle_values(m % 2 == 0 ? flexor() : extensor()), {{k, 1.0}}, {}});
    for (int f = 0; f < own; ++f) p.muscles[k].chains.push_back({f, m * own + f, 0.7});
    for (int f = own; f < own + shared; ++f) p.muscles[k].chains.push_back({f, muscles * own + f - own, 1.1});
  }
  p.channels = {{"a", {0.05, 0.9, 0.0, 0.04, 0.015, 0.05, 1.0}, {}},
                {"b", {0.05, 1.0, -1.5, 0.04, 0.015, 0.05, 0.8}, {}}};
  p.joints = {{"hip", 0, {0.4, 0.0, 1.5, -0.3}, {}}, {"knee", 1, {0.2, 0.0, 0.5, 0.1}, {}}};
  p.channels[1].chains = {{kGain, 0, 1.0}};  // and a parameter of the first muscle
  p.joints[0].chains = {{kStiffness, unknowns - 1, 1.0}};
  p.joints[1].chains = {{kOffset, 1, 0.5}, {kStiffness, 1, 0.5}};
  p.default_q = Eigen::VectorXd::Zero(2);
  Eigen::MatrixXd root(unknowns, unknowns);
  for (Eigen::Index i = 0; i < root.size(); ++i) root(i) = std::sin(1.0 + 0.7 * static_cast<double>(i * i % 101));
  p.covariance = 1e-6 * root * root.transpose();
  return p;
}

const Input kAtTheLeg{{0.3, 0.2}, {1.1, 0.4}, {-0.8, 0.5}};

/// Expects the bands that differences of the whole prediction in each unknown give.
void expect_bands_of_differences(const Predictor& p, const Input& in) {
  const PredictorWorkspace w = predicted(p, in);
  const Eigen::Index unknowns = p.covariance.rows();
  Eigen::MatrixXd by_torque(unknowns, w.torque_nm.size()), by_force(unknowns, w.force_n.size());
  for (Eigen::Index j = 0; j < unknowns; ++j) {
    constexpr double kStep = 1e-6;
    const auto moved = [&](double step) {
      Predictor other = p;
      const auto move = [&](auto& owners) {
        for (auto& owner : owners)
          for (const auto& c : owner.chains)
            if (c.variable == j) owner.values[static_cast<std::size_t>(c.field)] += step * c.slope;
      };
      move(other.muscles);
      move(other.channels);
      move(other.joints);
      return predicted(other, in);
    };
    const PredictorWorkspace up = moved(kStep), down = moved(-kStep);
    by_torque.row(j) = (up.torque_nm - down.torque_nm).transpose() / (2.0 * kStep);
    by_force.row(j) = (up.force_n - down.force_n).transpose() / (2.0 * kStep);
  }
  for (Eigen::Index j = 0; j < w.torque_nm.size(); ++j) {
    const double variance = by_torque.col(j).dot(p.covariance * by_torque.col(j)) + p.torque_sd_nm * p.torque_sd_nm;
    EXPECT_NEAR(w.torque_sd_nm[j], std::sqrt(variance), 1e-6 * (1.0 + std::sqrt(variance)));
  }
  for (Eigen::Index m = 0; m < w.force_n.size(); ++m) {
    const double sd = std::sqrt(by_force.col(m).dot(p.covariance * by_force.col(m)));
    EXPECT_NEAR(w.force_sd_n[m], sd, 1e-5 * (1.0 + sd));
  }
}

TEST(Predictor, HasTheBandThatDifferencesInTheUnknownsGive) { expect_bands_of_differences(elbow(), {}); }

TEST(Predictor, HasItWhereUnknownsBelongToOneMuscleAndWhereTheyAreShared) {
  const Predictor own = leg(9, 5, 0), shared = leg(9, 1, 4);
  EXPECT_TRUE(workspace_for(own).bands.by_block());
  EXPECT_FALSE(workspace_for(shared).bands.by_block());
  expect_bands_of_differences(own, kAtTheLeg);
  expect_bands_of_differences(shared, kAtTheLeg);
}

TEST(Predictor, HasTheSameTorquesWithoutBands) {
  const Predictor p = elbow();
  const PredictorWorkspace with = predicted(p);
  PredictorWorkspace without = workspace_for(p);
  const Input in;
  ASSERT_EQ(predict(p, in.envelope, in.angle, in.speed, without, false), Prediction::done);
  EXPECT_EQ(with.torque_nm, without.torque_nm);
  EXPECT_EQ(with.force_n, without.force_n);
  EXPECT_EQ(without.torque_sd_nm[0], 0.0);
}

TEST(Predictor, AllocatesNothingAfterTheWorkspaceIsMade) {
  long before = 0;
  for (const Predictor& p : {leg(80, 7, 0), leg(9, 1, 4), elbow()}) {
    PredictorWorkspace w = workspace_for(p);
    Input in = p.joints.size() == 2 ? kAtTheLeg : Input{};
    before = allocations;
    for (int i = 0; i < 1000; ++i) {
      in.angle[0] = 0.002 * i;
      (void)predict(p, in.envelope, in.angle, in.speed, w);
    }
    EXPECT_EQ(allocations - before, 0);
  }
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const Eigen::VectorXd one = Eigen::VectorXd::Zero(100);
  EXPECT_GT(allocations - before, 0) << one.sum() << ": allocations are counted";
#endif
}

TEST(Predictor, GivesTheSameNumbersToEveryThread) {
  const Predictor p = elbow();
  const auto sum = [&p] {
    PredictorWorkspace w = workspace_for(p);
    Input in;
    double total = 0.0;
    for (int i = 0; i < 2000; ++i) {
      in.angle[0] = 0.001 * i;
      (void)predict(p, in.envelope, in.angle, in.speed, w);
      total += w.torque_nm[0] + w.torque_sd_nm[0];
    }
    return total;
  };
  const double alone = sum();
  std::vector<double> found(4, 0.0);
  std::vector<std::jthread> threads;
  for (double& each : found) threads.emplace_back([&each, &sum] { each = sum(); });
  threads.clear();
  for (const double each : found) EXPECT_EQ(each, alone);
}

TEST(Predictor, RefusesNumbersThatAreNoneAndAnglesBeyondTheRange) {
  const Predictor p = elbow();
  PredictorWorkspace w = workspace_for(p);
  const auto end = [&](const Input& in) { return predict(p, in.envelope, in.angle, in.speed, w); };
  EXPECT_EQ(end({.envelope = {kNan, 0.1}}), Prediction::not_a_number);
  EXPECT_EQ(end({.envelope = {-0.1, 0.1}}), Prediction::not_a_number);
  EXPECT_EQ(end({.angle = {kNan}}), Prediction::not_a_number);
  EXPECT_EQ(end({.speed = {kInfinity}}), Prediction::not_a_number);
  EXPECT_EQ(end({.angle = {2.1}}), Prediction::out_of_range);
  EXPECT_EQ(end({}), Prediction::done);
}

/// The fit's own way from envelope to activation, at the samples of the envelope.
TEST(Predictor, FollowsAnEnvelopeAsTheFitDoes) {
  constexpr Eigen::Index kCount = 400;
  constexpr double kStep = 0.005;
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(kCount, 0.0, kStep * (kCount - 1));
  const Eigen::VectorXd u = (0.4 + 0.35 * (9.0 * time.array()).sin()).matrix();
  const Envelope envelope(time, u);
  for (const double shape : {0.0, -2.0}) {
    for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
      const ChannelValues channel{0.08, 0.8, shape, 0.04, 0.015, 0.05, 0.9};
      constexpr LagShares kShare;
      Predictor p;
      p.channels = {{"c", channel, {}}};
      if (lag == EmgLag::shared) {
        p.channels[0].lags = true;
        p.channels[0].values[kExcitationTime] = kShare.excitation * 0.08;
        p.channels[0].values[kActivationTime] = kShare.activation * 0.08;
        p.channels[0].values[kDeactivationTime] = kShare.deactivation * 0.08;
      }
      const double pure_s = lag == EmgLag::shared ? kShare.pure * 0.08 : 0.08;
      const Eigen::VectorXd later = time.array() + pure_s;
      const std::vector<Activation> expected = activation(envelope, later, channel, lag);
      PredictorWorkspace w = workspace_for(p);
      for (Eigen::Index i = 0; i < kCount; ++i) {
        double acting = 0.0;
        follow(p, {&u[i], 1}, kStep, w, {&acting, 1});
        const Activation a = activation_at(acting, p.channels[0].values);
        const Activation& e = expected[static_cast<std::size_t>(i)];
        ASSERT_NEAR(a.value, e.value, 1e-12) << i << name(lag);
        for (const ChannelField f : {kGain, kShape, kExponent}) ASSERT_NEAR(a.by_field[f], e.by_field[f], 1e-11) << f;
      }
    }
  }
}

}  // namespace
}  // namespace myoid::results
