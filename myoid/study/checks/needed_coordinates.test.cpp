#include "myoid/study/checks/needed_coordinates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using testing::Contains;
using testing::Not;

TEST(NeededCoordinates, OfAMeasuredTorqueAreThoseOfThePathsElseOfTheLimbToo) {
  const Study study = test_trials::arm_study();
  TrialSpec trial;
  const std::vector<std::string> all = needed_coordinates(study, test_trials::arm(), trial);
  EXPECT_EQ(all.size(), test_trials::arm().coordinates.size());
  trial.external_torque = "torque.sto";
  const std::vector<std::string> few = needed_coordinates(study, test_trials::arm(), trial);
  EXPECT_LT(few.size(), all.size());
  EXPECT_THAT(few, Contains("elbow_flexion"));
}

}  // namespace
}  // namespace myoid::study
