#include "myoid/opensim/moving_bodies.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::opensim {
namespace {

/// A slider along x that carries a pendulum about z.
body::BodyModel cart() {
  body::BodyModel m;
  m.name = "cart";
  m.bodies = {{.name = "ground"},
              {.name = "cart", .mass_kg = 2.0},
              {.name = "rod", .mass_kg = 3.0, .p_BBcm_B = Vec3(0.0, -0.5, 0.0)}};
  m.coordinates = {{.name = "x", .joint = 0, .motion = body::MotionType::translational}, {.name = "angle", .joint = 1}};
  body::Joint slider;
  slider.name = "slider";
  slider.child = 1;
  slider.coordinates = {0};
  body::Joint hinge;
  hinge.name = "hinge";
  hinge.parent = 1;
  hinge.child = 2;
  hinge.coordinates = {1};
  for (body::Joint* joint : {&slider, &hinge}) {
    for (std::size_t k = 0; k < 3; ++k)
      joint->rotation[k].axis = joint->translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
  }
  slider.translation[0] = {Vec3::UnitX(), 0, body::Linear{1.0, 0.0}};
  hinge.rotation[2] = {Vec3::UnitZ(), 1, body::Linear{1.0, 0.0}};
  m.joints = {slider, hinge};
  return body::finalize(std::move(m));
}

// Closed form: p = (x + L sin a, -L cos a) and its two derivatives; round-off.
TEST(MovingBodies, ThePendulumOnACartMovesAsItsFormulasSay) {
  const body::BodyModel m = cart();
  const double x = 0.3, a = 0.7, dx = -0.4, da = 1.9, ddx = 0.8, dda = -2.5, L = 0.5;
  const std::vector<Channel> channels{{"x", Unit::meter}, {"angle", Unit::radian}};
  const auto row = [&](double first, double second) {
    return TimeSeries(Eigen::VectorXd::Zero(1), channels, Eigen::RowVector2d(first, second));
  };
  const body::JointMotion motion{row(x, a), row(dx, da), row(0.0, 0.0)};
  const Eigen::MatrixXd qddot = Eigen::RowVector2d(ddx, dda);
  MovingBodies moving(m, motion, &qddot);
  moving.set(0);
  const Vec3 p(x + L * std::sin(a), -L * std::cos(a), 0.0);
  const Vec3 v(dx + L * da * std::cos(a), L * da * std::sin(a), 0.0);
  const Vec3 acceleration(ddx + L * (dda * std::cos(a) - da * da * std::sin(a)),
                          L * (dda * std::sin(a) + da * da * std::cos(a)), 0.0);
  const body::PointMotion center = moving.center(2);
  EXPECT_LT((center.p - p).norm(), 1e-14);
  EXPECT_LT((center.v - v).norm(), 1e-14);
  EXPECT_LT((center.a - acceleration).norm(), 1e-14);
  const body::PointMotion all = moving.center_of_all();
  EXPECT_LT((all.p - (2.0 * Vec3(x, 0.0, 0.0) + 3.0 * p) / 5.0).norm(), 1e-14);
  EXPECT_LT((all.v - (2.0 * Vec3(dx, 0.0, 0.0) + 3.0 * v) / 5.0).norm(), 1e-14);
  EXPECT_LT((all.a - (2.0 * Vec3(ddx, 0.0, 0.0) + 3.0 * acceleration) / 5.0).norm(), 1e-14);
  EXPECT_DOUBLE_EQ(moving.angular_velocity(2).z(), da);
  EXPECT_DOUBLE_EQ(moving.angular_acceleration(2).z(), dda);
}

}  // namespace
}  // namespace myoid::opensim
