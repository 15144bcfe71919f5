#include "myoid/methods/motion_alone.h"

#include <gtest/gtest.h>

#include "tests/support/swing.h"

namespace myoid::identification {
namespace {

using test::swing;

TEST(MotionAlone, WarnsWhereASpringAndAnInertiaTellTheTorque) {
  StudyData data;
  data.trials = {swing(0.0), swing(0.0)};
  data.muscles.push_back({.name = "BIC"});
  IdentificationResult result;
  result.estimates.push_back({.muscle = "BIC", .verdict = Verdict::identified});
  result.estimates.push_back({.muscle = "subject", .verdict = Verdict::identified});  // the delay
  judge_motion_alone(data, result);
  EXPECT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.estimates[0].verdict, Verdict::weak);
  EXPECT_EQ(result.estimates[1].verdict, Verdict::weak);
}

TEST(MotionAlone, SaysNothingOfAnEffortBesideTheMotion) {
  StudyData data;
  data.trials = {swing(2.0)};
  IdentificationResult result;
  judge_motion_alone(data, result);
  EXPECT_TRUE(result.warnings.empty());
}

}  // namespace
}  // namespace myoid::identification
