#include "myoid/body/scene/model_sticks.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

/// A chain of hinges: ground, then each body on the one before it, `children` on the last.
body::BodyModel tree(const std::vector<Vec3>& children) {
  body::BodyModel m;
  m.bodies = {{.name = "ground"}, {.name = "trunk", .mass_kg = 10.0}};
  const auto weld = [&](int parent, int child, const Vec3& where) {
    body::Joint joint;
    joint.name = "j" + std::to_string(child);
    joint.parent = parent;
    joint.child = child;
    joint.X_PF.p = where;
    for (std::size_t k = 0; k < 3; ++k)
      joint.rotation[k].axis = joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
    m.joints.push_back(joint);
  };
  weld(0, 1, {0.0, 1.0, 0.0});
  for (const Vec3& where : children) {
    const auto body = static_cast<int>(m.bodies.size());
    m.bodies.push_back({.name = "b" + std::to_string(body), .mass_kg = 1.0 / body});
    weld(1, body, where);
  }
  return body::finalize(m);
}

TEST(BodySticks, LeadFromJointToJoint) {
  const auto sticks = body_sticks(tree({{0.0, -0.4, 0.0}}));
  EXPECT_TRUE(sticks[0].empty());
  ASSERT_EQ(sticks[1].size(), 1U);
  EXPECT_EQ(sticks[1][0][0], Vec3::Zero());
  EXPECT_EQ(sticks[1][0][1], Vec3(0.0, -0.4, 0.0));
}

TEST(BodySticks, HangAPatellaOnTheKneeAndNotOnTheHip) {
  const auto sticks = body_sticks(tree({{0.0, -0.4, 0.0}, {0.05, -0.38, 0.0}}))[1];
  ASSERT_EQ(sticks.size(), 2U);
  EXPECT_EQ(sticks[0][0], Vec3(0.0, -0.4, 0.0));
  EXPECT_EQ(sticks[0][1], Vec3(0.05, -0.38, 0.0));
  EXPECT_EQ(sticks[1][0], Vec3::Zero());
}

TEST(BodySticks, GiveTwoShouldersOneSpine) {
  const auto sticks = body_sticks(tree({{0.0, 0.4, 0.2}, {0.0, 0.4, -0.2}}))[1];
  ASSERT_EQ(sticks.size(), 3U);
  EXPECT_LT((sticks[0][1] - Vec3(0.0, 0.4, 0.0)).norm(), 1e-15);  // a mean of two
  EXPECT_EQ(sticks[1][0], sticks[0][1]);
  EXPECT_EQ(sticks[2][0], sticks[0][1]);
}

TEST(BodySticks, OfALastBodyReachItsFarthestPointBeyondTheMassCenter) {
  body::BodyModel m = tree({});
  EXPECT_TRUE(body_sticks(m)[1].empty());  // nothing says which way
  m.bodies[1].p_BBcm_B = {0.0, -0.1, 0.0};
  EXPECT_EQ(body_sticks(m)[1][0][1], Vec3(0.0, -0.1, 0.0));
  m.markers = {{"tip", 1, {0.03, -0.3, 0.0}}};
  EXPECT_EQ(body_sticks(m)[1][0][1], Vec3(0.0, -0.3, 0.0));
}

TEST(BodySticks, FollowAJointThatMovesItsChildAway) {
  // gait2354's knee is a translation of 0.4 m by the knee angle: its place in the femur is not the
  // joint's frame there, which is the hip.
  const auto file = test::data_folder() / "opensim/gait2354/model.osim";
  MYOID_REQUIRE_DATA(file);
  const body::BodyModel m = body::read_osim(file);
  const auto femur = static_cast<std::size_t>(*m.find_body("femur_r"));
  const auto sticks = body_sticks(m)[femur];
  ASSERT_EQ(sticks.size(), 1U);
  EXPECT_NEAR((sticks[0][1] - sticks[0][0]).norm(), 0.43, 0.05);  // a femur
}

}  // namespace
}  // namespace myoid::body
