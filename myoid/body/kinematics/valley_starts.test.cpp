#include "myoid/body/kinematics/valley_starts.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/body/model/joint_posture.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {
namespace {

/// One body on a joint with three axes at right angles, as a shoulder: flexion, abduction, turn.
body::BodyModel shoulder() {
  std::string coordinates, axes;
  const auto add = [&](int number, const char* name, const char* axis, double lower, double upper) {
    coordinates += fmt::format("<Coordinate name=\"{}\"><range>{} {}</range><clamped>true</clamped></Coordinate>", name,
                               lower, upper);
    axes += fmt::format(
        "<TransformAxis name=\"rotation{}\"><coordinates>{}</coordinates><axis>{}</axis>"
        "<LinearFunction><coefficients>1 0</coefficients></LinearFunction></TransformAxis>",
        number, name, axis);
  };
  add(1, "flexion", "0 0 1", -1.5, 2.6);
  add(2, "abduction", "1 0 0", -2.0, 1.5);
  add(3, "turn", "0 1 0", -1.5, 1.5);
  return body::parse_osim(
      "<?xml version=\"1.0\"?><OpenSimDocument Version=\"40000\"><Model name=\"m\"><Ground name=\"ground\"/>"
      "<BodySet name=\"b\"><objects><Body name=\"arm\"><mass>1</mass></Body></objects></BodySet><JointSet name=\"j\">"
      "<objects><CustomJoint name=\"shoulder\"><socket_parent_frame>/ground</socket_parent_frame>"
      "<socket_child_frame>/bodyset/arm</socket_child_frame><coordinates>" +
          coordinates + "</coordinates><SpatialTransform>" + axes +
          "</SpatialTransform></CustomJoint></objects></JointSet></Model></OpenSimDocument>",
      "shoulder.osim");
}

const std::vector<Eigen::Index> kAngles{0, 1, 2};

/// The curvature of a body whose every turn of an angle a about an axis costs a^2 / 2: the products of the axes.
LimbMinimum minimum_at(const body::BodyModel& m, const Eigen::VectorXd& q, double part_m2) {
  const body::JointPosture p = body::joint_posture(m.joints.front(), q);
  Mat3 axes;
  for (int i = 0; i < 3; ++i) axes.col(i) = p.axis_F[static_cast<std::size_t>(i)];
  return {kAngles, axes.transpose() * axes, part_m2};
}

double turn_between(const body::BodyModel& m, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Mat3 Ra = body::joint_posture(m.joints.front(), a).X_FM.R, Rb = body::joint_posture(m.joints.front(), b).X_FM.R;
  return Eigen::AngleAxisd(Ra.transpose() * Rb).angle();
}

TEST(ValleyStarts, LieAtBothEndsOfTheValleyOfALockedJoint) {
  const body::BodyModel m = shoulder();
  const Eigen::VectorXd q = Eigen::Vector3d(0.4, -0.5 * kPi + 0.05, 0.3);
  const auto starts = valley_starts(m, q, minimum_at(m, q, 0.02));
  ASSERT_GE(starts.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const Eigen::VectorXd& start = starts[k];
    EXPECT_TRUE(std::any_of(kAngles.begin(), kAngles.end(), [&](Eigen::Index c) {
      return lies_at_end(m.coordinates[static_cast<std::size_t>(c)], start[c]);
    }));
    EXPECT_GT(std::abs(start[0] - q[0]), 0.5);
    // Two axes 0.05 rad from parallel: turns against each other by a leave at most twice that angle.
    EXPECT_LT(turn_between(m, start, q), 0.1);
  }
  EXPECT_GT((starts[0] - starts[1]).cwiseAbs().maxCoeff(), 1.0);
}

TEST(ValleyStarts, AreTheOtherAnglesBroughtIntoTheirRanges) {
  const body::BodyModel m = shoulder();
  const Eigen::VectorXd q = Eigen::Vector3d(1.4, -0.5 * kPi + 0.15, 1.5);
  const auto starts = valley_starts(m, q, minimum_at(m, q, 0.02));
  // (1.4 - pi, -pi - q2, 1.5 - pi) is the same rotation; two angles lie a little outside.
  const Eigen::Vector3d twin(-1.5, -0.5 * kPi - 0.15, -1.5);
  EXPECT_TRUE(std::any_of(starts.begin(), starts.end(),
                          [&](const auto& start) { return (start - twin).cwiseAbs().maxCoeff() < 1e-9; }));
}

TEST(ValleyStarts, AreNoneFarFromALockOrWhereTheLimbFits) {
  const body::BodyModel m = shoulder();
  const Eigen::VectorXd free = Eigen::Vector3d(0.4, -0.8, 0.3), locked = Eigen::Vector3d(0.4, -0.5 * kPi + 0.05, 0.3);
  EXPECT_TRUE(valley_starts(m, free, minimum_at(m, free, 0.02)).empty());
  EXPECT_TRUE(valley_starts(m, locked, minimum_at(m, locked, 1e-9)).empty());
}

}  // namespace
}  // namespace myoid::body
