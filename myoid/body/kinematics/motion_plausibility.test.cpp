#include "myoid/body/kinematics/motion_plausibility.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// An elbow that swings by 50 degrees at 0.5 Hz for 5 s, at 100 Hz; times and values by these factors.
TimeSeries swing(double time_factor, double value_factor = 1.0) {
  Eigen::VectorXd t(501), q(501);
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const double time_s = 0.01 * static_cast<double>(i);
    t[i] = time_factor * time_s;
    q[i] = value_factor * 50.0 * kDegree * std::sin(kPi * time_s);
  }
  return {t, {{"elbow_flexion", Unit::radian}}, q};
}

std::vector<RemarkCode> codes(const std::vector<Remark>& remarks) {
  std::vector<RemarkCode> list;
  for (const Remark& remark : remarks) list.push_back(remark.code);
  return list;
}

TEST(ImplausibleMotion, AUsualMovementIsNot) { EXPECT_TRUE(implausible_motion(swing(1.0)).empty()); }

TEST(ImplausibleMotion, AThousandTimesTooFastIsAnErrorOfClockAndSpeed) {
  const std::vector<Remark> found = implausible_motion(swing(1e-3));
  ASSERT_EQ(codes(found), (std::vector{RemarkCode::motion_impossible, RemarkCode::motion_impossible}));
  EXPECT_EQ(found[0].about, "clock");
  EXPECT_NEAR(*found[0].value, 1e5, 1.0);
  EXPECT_EQ(found[1].about, "elbow_flexion");
  // 95 % of the time |cos| is below 0.99692: 50 deg pi 0.99692 / ms.
  EXPECT_NEAR(*found[1].value, 50.0 * kDegree * kPi * 0.99692 * 1e3, 2.0);
  EXPECT_EQ(found[1].severity, Severity::error);
}

TEST(ImplausibleMotion, ValuesInAnotherUnitAreTooFast) {
  EXPECT_EQ(codes(implausible_motion(swing(1.0, 180.0 / kPi))), std::vector{RemarkCode::motion_impossible});
}

TEST(ImplausibleMotion, AClockInMillisecondsIsTooSlow) {
  const std::vector<Remark> found = implausible_motion(swing(1e3));
  ASSERT_EQ(codes(found), std::vector{RemarkCode::motion_impossible});
  EXPECT_EQ(found[0].says, slow_clock(swing(1e3).time_s()));
  EXPECT_EQ(slow_clock(swing(1.0).time_s()), "");
}

TEST(ImplausibleMotion, AWrongSampleIsAJumpAndOnlyWithinTheStretch) {
  const TimeSeries usual = swing(1.0);
  Eigen::MatrixXd values = usual.values();
  values(300, 0) += 0.3;
  const TimeSeries motion(usual.time_s(), usual.channels(), values);
  EXPECT_EQ(codes(implausible_motion(motion)), std::vector{RemarkCode::angle_jump});
  EXPECT_TRUE(implausible_motion(motion, {0.0, 2.0}).empty());
}

TEST(ImplausibleMotion, OfAModelNamesTheCoordinatesThatTheMotionLacksButForLockedOnes) {
  body::BodyModel model = body::parse_osim(body::arm4_osim({.forearm_rotations = true}), "arm4.osim");
  for (body::Coordinate& c : model.coordinates) c.locked = false;
  std::vector<Remark> found = implausible_motion(model, swing(1.0));
  ASSERT_EQ(codes(found), std::vector{RemarkCode::coordinate_absent});
  EXPECT_EQ(found[0].value, static_cast<double>(model.coordinates.size() - 1));
  for (body::Coordinate& c : model.coordinates) c.locked = c.name != "elbow_flexion";
  EXPECT_TRUE(implausible_motion(model, swing(1.0)).empty());
}

TEST(ImplausibleMotion, OfAModelAnAngleOfTheOtherSignIsAnErrorOfEveryCoordinate) {
  body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  for (body::Coordinate& c : model.coordinates) c.locked = c.name != "elbow_flexion";
  const TimeSeries usual = swing(1.0);
  const auto bent = [&](double sign) {
    return TimeSeries(usual.time_s(), usual.channels(), sign * (usual.values().array() + 70.0 * kDegree).matrix());
  };
  EXPECT_TRUE(implausible_motion(model, bent(1.0)).empty());
  const std::vector<Remark> found = implausible_motion(model, bent(-1.0));
  ASSERT_EQ(codes(found), std::vector{RemarkCode::angle_outside_range});
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_EQ(found[0].about, "elbow_flexion");
}

}  // namespace
}  // namespace myoid::body
