#include "myoid/body/dynamics/instrument_load.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// A handle that turns about the laboratory's z axis at (1, 2, 0), its cell 0.1 m along its x axis.
body::BodyModel handle() {
  return body::parse_osim(
      R"(<OpenSimDocument Version="40000"><Model name="handle"><gravity>0 -9.81 0</gravity>
<BodySet><objects><Body name="box"><mass>1</mass><mass_center>0 0 0</mass_center>
<inertia>1 1 1 0 0 0</inertia></Body><Body name="cell"><mass>0.1</mass>
<mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>
<JointSet><objects><PinJoint name="turn"><socket_parent_frame>at</socket_parent_frame>
<socket_child_frame>/bodyset/box</socket_child_frame>
<coordinates><Coordinate name="angle"/></coordinates><frames><PhysicalOffsetFrame name="at">
<socket_parent>/ground</socket_parent><translation>1 2 0</translation>
</PhysicalOffsetFrame></frames></PinJoint>
<WeldJoint name="fixed"><socket_parent_frame>on_box</socket_parent_frame>
<socket_child_frame>/bodyset/cell</socket_child_frame><frames><PhysicalOffsetFrame name="on_box">
<socket_parent>/bodyset/box</socket_parent><translation>0.1 0 0</translation>
</PhysicalOffsetFrame></frames></WeldJoint></objects></JointSet></Model></OpenSimDocument>)",
      "handle.osim");
}

constexpr Eigen::Index kFrames = 101;

TimeSeries turning() {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(kFrames, 0.0, 1.0);
  return {t, {{"angle", Unit::radian}}, Eigen::MatrixXd(kPi * t)};
}

/// 10 N along the cell's x axis, 2 N m about it, at another rate.
TimeSeries wrench(double end_s = 1.0) {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(501, 6);
  w.col(0).setConstant(10.0);
  w.col(3).setConstant(2.0);
  return {Eigen::VectorXd::LinSpaced(501, 0.0, end_s),
          {{"Fx", Unit::newton},
           {"Fy", Unit::newton},
           {"Fz", Unit::newton},
           {"Mx", Unit::newton_meter},
           {"My", Unit::newton_meter},
           {"Mz", Unit::newton_meter}},
          w};
}

TEST(InstrumentLoad, FollowsTheCellInGround) {
  const body::BodyModel object = handle();
  const ExternalForce load = instrument_load(object, turning(), *object.find_body("cell"), wrench(), 3, "grip");
  EXPECT_EQ(load.body, 3);
  EXPECT_EQ(load.force_frame, 0);
  for (const double t : {0.25, 0.5, 0.8}) {
    const Vec3 x_axis(std::cos(kPi * t), std::sin(kPi * t), 0.0);
    // A cubic through samples of a sine 10 ms apart: 5/384 (pi h)^4 = 1e-8 of its amplitude.
    EXPECT_LT((load.force->at(t) - 10.0 * x_axis).norm(), 1e-6);
    EXPECT_LT((load.torque->at(t) - 2.0 * x_axis).norm(), 1e-6);
    EXPECT_LT((load.point->at(t) - Vec3(1.0, 2.0, 0.0) - 0.1 * x_axis).norm(), 1e-8);
  }
}

TEST(InstrumentLoad, InThePersonsOwnModelItIsTheSameWrench) {
  const body::BodyModel object = handle();
  const body::BodyIndex cell = *object.find_body("cell");
  const body::BodyIndex box = *object.find_body("box");
  ExternalLoads apart;
  apart.forces = {instrument_load(object, turning(), cell, wrench(), box, "grip")};
  ExternalLoads within;
  within.forces = {instrument_load(cell, wrench(), box, "grip")};
  body::BodyState state = body::make_state(object);
  body::compute_poses(object, Eigen::VectorXd::Constant(1, 0.3 * kPi), state);
  std::vector<body::BodyWrench> a;
  std::vector<body::BodyWrench> b;
  apart.append_wrenches(state, 0.3, a);
  within.append_wrenches(state, 0.3, b);
  ASSERT_EQ(a.size(), 1U);
  EXPECT_LT((a[0].f_G - b[0].f_G).norm(), 1e-6);
  EXPECT_LT((a[0].m_G - b[0].m_G).norm(), 1e-6);
  EXPECT_NEAR(b[0].f_G.norm(), 10.0, 1e-12);
}

TEST(InstrumentLoad, RefusesALoadThatEndsBeforeTheMotion) {
  const body::BodyModel object = handle();
  EXPECT_THROW(static_cast<void>(instrument_load(object, turning(), *object.find_body("cell"), wrench(0.5), 1, "grip")),
               InvalidInput);
}

}  // namespace
}  // namespace myoid::body
