#include "myoid/body/kinematics/angular_speeds.h"

#include <random>

#include <gtest/gtest.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

/// A body of 2 kg on a joint of a kind, at a frame that is turned and shifted.
body::BodyModel on_joint(const std::string& kind, int coordinates, const body::Compat& compat) {
  std::string text =
      "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><BodySet><objects><Body name=\"b\">"
      "<mass>2</mass><mass_center>0.1 -0.2 0.05</mass_center><inertia>0.2 0.3 0.25 0.01 0 0.02"
      "</inertia></Body></objects></BodySet><JointSet><objects><" +
      kind +
      " name=\"j\"><socket_parent_frame>base</socket_parent_frame><socket_child_frame>/bodyset/b"
      "</socket_child_frame><radii_x_y_z>0.1 0.15 0.2</radii_x_y_z><coordinates>";
  for (int k = 0; k < coordinates; ++k) text += "<Coordinate name=\"q" + std::to_string(k) + "\"/>";
  text +=
      "</coordinates><frames><PhysicalOffsetFrame name=\"base\"><socket_parent>/ground"
      "</socket_parent><translation>0.3 0.1 0</translation><orientation>0.2 -0.4 0.7"
      "</orientation></PhysicalOffsetFrame></frames></" +
      kind + "></objects></JointSet></Model></OpenSimDocument>";
  return body::parse_osim(text, "m.osim", {.compat = compat});
}

JointMotion one_row(const body::BodyModel& model, const Eigen::MatrixXd& rows) {
  std::vector<Channel> channels;
  for (const body::Coordinate& c : model.coordinates) channels.push_back({c.name, Unit::dimensionless});
  const auto series = [&](int row) {
    return TimeSeries(Eigen::VectorXd::Zero(1), channels, Eigen::MatrixXd(rows.row(row)));
  };
  return {series(0), series(1), series(2)};
}

class AngularSpeeds : public ::testing::TestWithParam<std::pair<const char*, int>> {};

// The definition: with speeds u the body's angular velocity in the joint's parent frame is u, and
// its derivative is du/dt; the pose is differentiated by central differences of step h, so that
// the truncation is of the order h^2 = 1e-8 and the rounding 1e-16 / h^2 for second derivatives.
TEST_P(AngularSpeeds, AreTheAngularVelocityOfTheBodyInItsParentFrame) {
  const auto [kind, count] = GetParam();
  const body::BodyModel model = on_joint(kind, count, body::kOpenSim452);
  std::mt19937 random(4711);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(3, count, [&] { return number(random); });
    const JointMotion moved = moved_by_speeds(model, one_row(model, rows));
    const Eigen::VectorXd q = moved.q.values().row(0), qd = moved.qdot.values().row(0),
                          qdd = moved.qddot.values().row(0);
    body::BodyState state = body::make_state(model);
    const auto rotation = [&](double t) {
      body::compute_poses(model, q + t * qd + 0.5 * t * t * qdd, state);
      return Mat3(model.joints[0].X_PF.R.transpose() * state.X_GB[1].R);
    };
    const auto angular_velocity = [&](double t) {
      constexpr double h = 1e-4;
      const Mat3 W = (rotation(t + h) - rotation(t - h)) / (2.0 * h) * rotation(t).transpose();
      return Vec3(W(2, 1), W(0, 2), W(1, 0));
    };
    EXPECT_LT((angular_velocity(0.0) - Vec3(rows.row(1).head<3>())).norm(), 1e-6);
    constexpr double h = 1e-3;
    const Vec3 acceleration = (angular_velocity(h) - angular_velocity(-h)) / (2.0 * h);
    EXPECT_LT((acceleration - Vec3(rows.row(2).head<3>())).norm(), 1e-4);
    // Forces on speeds and on rates have one power.
    const Eigen::VectorXd force = rows.row(0);
    EXPECT_NEAR(on_rates(model, q, force).dot(qd), force.dot(rows.row(1)), 1e-12);
    // Translations of a FreeJoint are rates in any case.
    EXPECT_EQ(qd.tail(count - 3), Eigen::VectorXd(rows.row(1).tail(count - 3)));
    EXPECT_LT((rates_of_speeds(model, q) * rows.row(1).transpose() - qd).norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Joints,
                         AngularSpeeds,
                         ::testing::Values(std::pair{"BallJoint", 3},
                                           std::pair{"FreeJoint", 6},
                                           std::pair{"EllipsoidJoint", 3}));

TEST(AngularSpeedsOfAModel, ActOnlyWhereOpenSimIsReproduced) {
  const body::BodyModel exact = on_joint("BallJoint", 3, {});
  EXPECT_FALSE(takes_rates_for_speeds(exact));
  const Eigen::MatrixXd rows = Eigen::MatrixXd::Constant(3, 3, 0.4);
  EXPECT_EQ(moved_by_speeds(exact, one_row(exact, rows)).qdot.values(), Eigen::MatrixXd(rows.row(1)));
  EXPECT_TRUE(takes_rates_for_speeds(on_joint("BallJoint", 3, body::kOpenSim452)));
  EXPECT_FALSE(takes_rates_for_speeds(on_joint("GimbalJoint", 3, body::kOpenSim452)));
}

}  // namespace
}  // namespace myoid::body
