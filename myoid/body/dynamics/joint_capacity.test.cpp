#include "myoid/body/dynamics/joint_capacity.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

#include "tests/support/built_in_arm.h"

namespace myoid::body {
namespace {

TEST(JointCapacity, OfTheElbowIsAboutWhatMenCanDo) {
  // Published maximal contractions of men, science of the elbow: flexion about 70 N m, extension
  // about 45 N m; generic models are stronger than the average by up to 2.
  const JointCapacity elbow = joint_capacity(test::built_in_arm(), "elbow_flexion");
  EXPECT_GT(elbow.positive_nm, 60.0);
  EXPECT_LT(elbow.positive_nm, 140.0);
  EXPECT_GT(elbow.negative_nm, 30.0);
  EXPECT_LT(elbow.negative_nm, 90.0);
  EXPECT_GT(elbow.lever_m, 0.1);
  EXPECT_LT(elbow.lever_m, 0.5);
}

TEST(JointCapacity, IsWhatTheMusclesDoWhereTheyDoMost) {
  // Pigeon's arms peak at 4.7 cm (BIC), 3 cm (BRA), 7 to 8 cm (BRD): with 1060, 987 and 261 N no
  // more than 50 + 30 + 21 N m, and no less than at 90 degrees 50 + 27 + 14.
  const JointCapacity elbow = joint_capacity(test::built_in_arm(), "elbow_flexion");
  EXPECT_NEAR(elbow.positive_nm, 97.0, 10.0);
}

TEST(JointCapacity, NobodyMakesMoreThanMusclesInLengtheningAndTheirOwnWeight) {
  const JointCapacity c{.positive_nm = 100.0, .negative_nm = 50.0, .lever_m = 0.3, .body_mass_kg = 80.0};
  EXPECT_NEAR(c.greatest_nm(), 3.75 * 100.0 + 80.0 * kStandardGravity * 0.3, 1e-9);
}

TEST(JointCapacity, RefusesACoordinateThatTheModelLacks) {
  EXPECT_THROW((void)joint_capacity(test::built_in_arm(), "knee"), ModelError);
}

TEST(MovedBodies, AreThoseBeyondTheJoint) {
  const body::BodyModel model = test::built_in_arm();
  const int elbow = model.coordinates[static_cast<std::size_t>(model.coordinate_index("elbow_flexion"))].joint;
  const std::vector<bool> moved = moved_bodies(model, elbow);
  EXPECT_TRUE(moved[static_cast<std::size_t>(*model.find_body("forearm_hand"))]);
  EXPECT_FALSE(moved[static_cast<std::size_t>(*model.find_body("upper_arm"))]);
  EXPECT_FALSE(moved[0]);
}

}  // namespace
}  // namespace myoid::body
