#include "myoid/run/resting_torque.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

#include "tests/support/data_folder.h"

namespace myoid::run {
namespace {

/// A joint moved from `low` to `high` and back, n samples.
struct Moved {
  Moved(double low, double high, Eigen::Index n) : angle_rad(n), velocity_radps(n) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double phase = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(n - 1);
      angle_rad[i] = 0.5 * (low + high) - 0.5 * (high - low) * std::cos(phase);
      velocity_radps[i] = 0.5 * (high - low) * std::sin(phase);
    }
  }
  Eigen::VectorXd angle_rad, velocity_radps;
};

TEST(RestingTorque, APolynomialOfTheFifthDegreeAndADashpotComeBack) {
  const Moved moved(0.2, 2.2, 401);
  const auto elastic = [](double q) {
    return 4.0 - 3.0 * q + 0.8 * q * q - 1.1 * std::pow(q, 3) + 0.4 * std::pow(q, 4) - 0.07 * std::pow(q, 5);
  };
  const Eigen::VectorXd torque = moved.angle_rad.unaryExpr(elastic) - 0.25 * moved.velocity_radps;
  const auto found = fit_resting_torque(moved.angle_rad, moved.velocity_radps, torque);
  ASSERT_TRUE(found);
  for (const double q : {0.2, 0.7, 1.3, 2.2}) EXPECT_NEAR(found->at(q), elastic(q), 1e-10);
  EXPECT_NEAR(found->viscosity_nms, 0.25, 1e-10);
  EXPECT_NEAR(found->residual_nm, 0.0, 1e-10);
}

TEST(RestingTorque, AnExponentialThatRisesTwentyfoldIsMetToAThousandth) {
  const Moved moved(0.0, 2.0, 401);
  const auto elastic = [](double q) { return -6.0 * std::exp(0.5 * std::log(20.0) * (q - 2.0)); };
  const auto found = fit_resting_torque(moved.angle_rad, moved.velocity_radps, moved.angle_rad.unaryExpr(elastic));
  ASSERT_TRUE(found);
  for (double q = 0.0; q <= 2.0; q += 0.05) EXPECT_NEAR(found->at(q), elastic(q), 6e-3);
}

TEST(RestingTorque, BeyondTheMeasuredAnglesTheWeightGoesOnAndTheRestStays) {
  const Moved moved(0.5, 1.5, 201);
  // 1 kg at 0.8 m and an offset: a weight's sine alone, known to the tenth that its prior pulls.
  const auto weight = [](double q) { return 7.8 * std::sin(q) + 3.0; };
  const auto found = fit_resting_torque(moved.angle_rad, moved.velocity_radps, moved.angle_rad.unaryExpr(weight));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->at(0.2), weight(0.2), 0.5);
  EXPECT_NEAR(found->at(1.8), weight(1.8), 0.5);
  // Stops of a joint, which no weight makes, are not continued.
  const auto stops = [](double q) { return -std::sinh(8.0 * (q - 1.0)); };
  const auto stiff = fit_resting_torque(moved.angle_rad, moved.velocity_radps, moved.angle_rad.unaryExpr(stops));
  ASSERT_TRUE(stiff);
  EXPECT_EQ(stiff->weight_sin_nm, 0.0);
  EXPECT_EQ(stiff->at(3.0), stiff->at(1.5));
}

TEST(RestingTorque, BesideAWeightAloneNothingIsLeft) {
  const Moved moved(-0.6, 0.5, 201);
  const Eigen::VectorXd weight = 9.0 * moved.angle_rad.array().cos() - 4.0;
  EXPECT_LT(beside_weight(moved.angle_rad, weight).cwiseAbs().maxCoeff(), 0.5);
  const Eigen::VectorXd held = Eigen::VectorXd::Constant(50, 0.3);
  EXPECT_LT(beside_weight(held, Eigen::VectorXd::Constant(50, -18.0)).cwiseAbs().maxCoeff(), 1e-12);
}

/// A passive trial on a dynamometer: dorsiflexion positive, speed over 0.2 s.
struct PassiveTrial {
  Eigen::VectorXd angle_rad, velocity_radps, torque_nm;
};

PassiveTrial passive_trial(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<std::array<double, 3>> rows;
  std::array<double, 3> row{};
  while (std::getline(file, line)) {
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &row[0], &row[1], &row[2]) == 3) rows.push_back(row);
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  PassiveTrial trial{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  const auto at = [&](Eigen::Index i) { return rows[static_cast<std::size_t>(std::clamp<Eigen::Index>(i, 0, n - 1))]; };
  for (Eigen::Index i = 0; i < n; ++i) {
    trial.torque_nm[i] = at(i)[1];
    trial.angle_rad[i] = -at(i)[2] * kDegree;
    trial.velocity_radps[i] = -(at(i + 20)[2] - at(i - 20)[2]) * kDegree / (at(i + 20)[0] - at(i - 20)[0]);
  }
  return trial;
}

TEST(RestingTorque, PassiveTrialsOfADynamometerPredictEachOther) {
  // Foot, plate and offset weigh up to 19 N m. As published, with nothing taken off; each trial is
  // predicted from the seven others. Held-out R2 of all together.
  const std::filesystem::path folder = test::data_folder() / "tecchio-ankle";
  MYOID_REQUIRE_DATA(folder);
  std::vector<PassiveTrial> trials;
  for (const char* name : {"-15", "-10", "5", "10", "20", "25", "Sho2Long", "Long2Sho"})
    trials.push_back(passive_trial(folder / (std::string("Pas_") + name + "_dynamometer.csv")));
  double sse = 0.0, sum = 0.0, squares = 0.0, count = 0.0;
  for (std::size_t left_out = 0; left_out < trials.size(); ++left_out) {
    PassiveTrial others;
    const auto add = [](Eigen::VectorXd& to, const Eigen::VectorXd& more) {
      to.conservativeResize(to.size() + more.size());
      to.tail(more.size()) = more;
    };
    for (std::size_t k = 0; k < trials.size(); ++k) {
      if (k == left_out) continue;
      add(others.angle_rad, trials[k].angle_rad);
      add(others.velocity_radps, trials[k].velocity_radps);
      add(others.torque_nm, trials[k].torque_nm);
    }
    const auto found = fit_resting_torque(others.angle_rad, others.velocity_radps, others.torque_nm);
    ASSERT_TRUE(found);
    const PassiveTrial& held = trials[left_out];
    const Eigen::VectorXd predicted = found->at(held.angle_rad) - found->viscosity_nms * held.velocity_radps;
    sse += (held.torque_nm - predicted).squaredNorm();
    sum += held.torque_nm.sum();
    squares += held.torque_nm.squaredNorm();
    count += static_cast<double>(held.torque_nm.size());
  }
  EXPECT_GT(1.0 - sse / (squares - sum * sum / count), 0.95);
}

TEST(RestingTorque, OverASmallRangeNoShapeIsSought) {
  const Moved moved(1.0, 1.2, 200);  // 11 degrees
  const auto found =
      fit_resting_torque(moved.angle_rad, moved.velocity_radps, -2.0 * (moved.angle_rad.array() - 1.1).matrix());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->coefficient_nm.size(), 1);
  EXPECT_NEAR(found->at(1.2), 0.0, 1e-3);
}

TEST(RestingTorque, AJointMovedOneWayHasItsDashpotInTheElasticPart) {
  const Eigen::VectorXd angle = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
  const Eigen::VectorXd velocity = Eigen::VectorXd::Constant(100, 0.5);
  const auto found = fit_resting_torque(angle, velocity, -0.2 * velocity);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->viscosity_nms, 0.0);
  EXPECT_NEAR(found->at(0.5), -0.1, 1e-12);
}

TEST(RestingTorque, TooFewSamplesOrANaNTellNothing) {
  const Moved moved(0.0, 2.0, 19);
  EXPECT_FALSE(fit_resting_torque(moved.angle_rad, moved.velocity_radps, moved.angle_rad));
  const Moved enough(0.0, 2.0, 40);
  Eigen::VectorXd torque = enough.angle_rad;
  torque[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit_resting_torque(enough.angle_rad, enough.velocity_radps, torque));
}

TEST(RestingTorque, AJointThatHardlyMovesHasNoDashpotToBeSeen) {
  const Moved moved(0.0, 2.0, 401);
  const Eigen::VectorXd creeping = 0.04 * moved.velocity_radps;
  const auto found = fit_resting_torque(moved.angle_rad, creeping, -0.25 * creeping);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->viscosity_nms, 0.0);
}

TEST(RestingTorque, TheResidualIsTheRootMeanSquareOfWhatIsLeft) {
  const Moved moved(0.0, 2.0, 4000);
  Eigen::VectorXd torque = -2.0 * moved.angle_rad;
  for (Eigen::Index i = 0; i < torque.size(); ++i) torque[i] += i % 2 == 0 ? 0.3 : -0.3;
  const auto found = fit_resting_torque(moved.angle_rad, moved.velocity_radps, torque);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->residual_nm, 0.3, 1e-3);
  Eigen::VectorXd velocity = moved.velocity_radps;
  velocity[9] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(fit_resting_torque(moved.angle_rad, velocity, torque));
}

}  // namespace
}  // namespace myoid::run
