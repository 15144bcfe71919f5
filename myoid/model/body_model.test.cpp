#include "myoid/model/body_model.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::model {
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

TEST(Finalize, RefusesALoop) {
  BodyModel m = two_bodies_in_the_wrong_order();
  Joint extra;
  extra.name = "extra";
  extra.child = 2;
  m.joints.push_back(extra);
  EXPECT_THROW((void)finalize(m), ModelError);
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

}  // namespace
}  // namespace myoid::model
