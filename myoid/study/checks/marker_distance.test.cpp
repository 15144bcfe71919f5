#include "myoid/study/checks/marker_distance.h"

#include <gtest/gtest.h>

#include "tests/support/resting_markers.h"
#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

/// The built-in arm with an elbow that turns by 1e-9 rad at most: no posture comes nearer to markers that are shifted.
body::BodyModel stiff_arm() {
  body::BodyModel model = arm();
  for (body::Coordinate& c : model.coordinates) c.locked = true;
  body::Coordinate& elbow = model.coordinates[static_cast<std::size_t>(model.coordinate_index("elbow_flexion"))];
  elbow.locked = false;
  elbow.clamped = true;
  elbow.lower = elbow.default_value;
  elbow.upper = elbow.default_value + 1e-9;
  return model;
}

/// With a model file no arm is made from the markers.
Study study_of_a_file() {
  Study study = arm_study();
  study.model.file = "arm.osim";
  return study;
}

std::optional<Remark> found_at(double shift_m) {
  const body::BodyModel model = stiff_arm();
  TrialInput input;
  input.markers = test::resting_markers(model, shift_m);
  const Study study = study_of_a_file();
  return distant_markers(study, study.trials[0], model, input);
}

// A model that cannot move leaves its markers at the distance of the shift.
TEST(DistantMarkers, AreMeasuredByInverseKinematicsAndWarnAtTheLimitsOfTheGate) {
  EXPECT_FALSE(found_at(0.0).has_value());
  EXPECT_FALSE(found_at(0.019).has_value());
  for (const double shift_m : {0.021, 0.9}) {
    const std::optional<Remark> found = found_at(shift_m);
    ASSERT_TRUE(found.has_value()) << shift_m;
    EXPECT_EQ(found->code, RemarkCode::model_unfit);
    EXPECT_EQ(found->severity, Severity::warning);
    EXPECT_EQ(found->where, "t");
    EXPECT_NEAR(*found->value, shift_m, 1e-8);
  }
}

TEST(DistantMarkers, OfASingleBadStretchAreFoundByOneOfTheSpreadFrames) {
  const body::BodyModel model = stiff_arm();
  TrialInput input;
  input.markers = test::resting_markers(model, 0.0);
  const Eigen::Index half = input.markers->frame_count() / 2;
  input.markers->positions_m.bottomRows(half) = test::resting_markers(model, 0.03).positions_m.bottomRows(half);
  const Study study = study_of_a_file();
  const std::optional<Remark> found = distant_markers(study, study.trials[0], model, input);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found->value, 0.03, 1e-8);
}

}  // namespace
}  // namespace myoid::study
