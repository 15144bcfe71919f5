#include "myoid/body/model/body_model.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "myoid/body/model/force_laws.h"
#include "myoid/body/model/muscle_properties.h"
#include "myoid/body/model/path_geometry.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

BodyModel two_bodies_in_the_wrong_order() {
  BodyModel m;
  m.bodies = {{.name = "ground"}, {.name = "upper"}, {.name = "lower"}};
  Joint elbow;
  elbow.name = "elbow";
  elbow.parent = 1;
  elbow.child = 2;
  Joint shoulder;
  shoulder.name = "shoulder";
  shoulder.child = 1;
  m.joints = {elbow, shoulder};
  return m;
}

TEST(Finalize, PutsAParentsJointBeforeItsChilds) {
  const BodyModel m = finalize(two_bodies_in_the_wrong_order());
  EXPECT_EQ(m.joints[0].name, "shoulder");
  EXPECT_EQ(m.joint_of_body, (std::vector<int>{-1, 0, 1}));
}

TEST(Finalize, CutsALoopWhereTheLongerWayCloses) {
  BodyModel m = two_bodies_in_the_wrong_order();
  m.bodies[1].mass_kg = 1.0;
  m.bodies[2].mass_kg = 2.0;
  Joint extra;
  extra.name = "extra";
  extra.child = 2;
  m.joints.push_back(extra);
  m = finalize(m);
  // "extra" reaches the lower body from ground first; "elbow" gets a copy with half of the mass.
  ASSERT_EQ(m.bodies.size(), 4U);
  EXPECT_EQ(m.bodies[2].mass_kg, 1.0);
  EXPECT_EQ(m.bodies[3].mass_kg, 1.0);
  EXPECT_EQ(m.joints[static_cast<std::size_t>(m.joint_of_body[2])].name, "extra");
  EXPECT_EQ(m.joints[static_cast<std::size_t>(m.joint_of_body[3])].name, "elbow");
  ASSERT_EQ(m.constraints.size(), 1U);
  EXPECT_EQ(m.constraints[0].class_name, "WeldConstraint");
}

TEST(Finalize, RefusesBodiesThatHangOnEachOther) {
  BodyModel m = two_bodies_in_the_wrong_order();
  m.joints[1].parent = 2;
  EXPECT_THROW((void)finalize(m), ModelError);
}

TEST(Finalize, TakesAMovingEndWithoutMass) {
  BodyModel m = two_bodies_in_the_wrong_order();
  m.coordinates = {{.name = "q"}};
  m.joints[0].coordinates = {0};
  m.bodies[1].mass_kg = 1.0;
  EXPECT_EQ(finalize(m).joints.size(), 2U);
}

TEST(CoordinateIndex, TellsTheNamesThereAre) {
  BodyModel m;
  m.coordinates = {{.name = "elbow_flexion"}};
  try {
    (void)m.coordinate_index("elbow");
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("elbow_flexion"), std::string::npos);
  }
}

TEST(Finalize, TakesALongChainInAnyOrderAsFastAsAShortOneABody) {
  // 100,000 joints, the last first: with a pass over all joints for every level this takes minutes.
  const int count = 100'000;
  BodyModel m;
  m.bodies.resize(count + 1);
  for (int b = 1; b <= count; ++b) {
    m.bodies[static_cast<std::size_t>(b)].name = std::to_string(b);
    m.bodies[static_cast<std::size_t>(b)].mass_kg = 1.0;
    Joint joint;
    joint.parent = count - b;
    joint.child = count - b + 1;
    m.joints.push_back(joint);
  }
  const BodyModel chain = finalize(std::move(m));
  for (int j = 0; j < count; ++j) ASSERT_EQ(chain.joints[static_cast<std::size_t>(j)].child, j + 1) << "level by level";
}

}  // namespace
}  // namespace myoid::body
