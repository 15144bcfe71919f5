#include "myoid/study/checks/fiber_room.h"

#include <gtest/gtest.h>

#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"
#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

TEST(FiberRoom, IsTheLengthWithoutTheTendon) {
  EXPECT_TRUE(fiber_room("BIC", 0.35, 0.2, 0.15).says.empty());
  EXPECT_TRUE(fiber_room("BIC", 0.2, 0.2, 0.15).none);
  EXPECT_TRUE(fiber_room("BIC", 0.19, 0.2, 0.15).none);
  for (const double relative : {0.09, 3.1}) {
    const FiberRoom room = fiber_room("BIC", 0.2 + relative * 0.15, 0.2, 0.15);
    EXPECT_FALSE(room.none);
    EXPECT_NE(room.says.find("fibers of BIC"), std::string::npos) << room.says;
  }
  for (const double relative : {0.11, 2.9})
    EXPECT_TRUE(fiber_room("BIC", 0.2 + relative * 0.15, 0.2, 0.15).says.empty()) << relative;
}

TEST(TendonsTooLong, AreThoseThatAreLongerThanThePathAtEveryAngle) {
  const Study study = test_trials::arm_study();
  body::BodyModel arm = test_trials::arm();
  EXPECT_TRUE(tendons_too_long(study, arm).empty());
  const int biceps = arm.muscle_index("BIC");
  const Eigen::VectorXd lengths = body::lengths_over_range_m(arm, biceps, arm.coordinate_index("elbow_flexion"), 12);
  double& tendon_m = arm.muscles[static_cast<std::size_t>(biceps)].properties.tendon_slack_length_m;
  // As long as the path at some angles only.
  tendon_m = 0.5 * (lengths.minCoeff() + lengths.maxCoeff());
  for (const Remark& found : tendons_too_long(study, arm)) EXPECT_EQ(found.severity, Severity::warning);
  // Millimeters that were read as meters.
  tendon_m = 183.5;
  const std::vector<Remark> found = tendons_too_long(study, arm);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  for (const char* part : {"[[muscle]] BIC", "183.5 m leave no fiber", "m long in this model", "tendon_slack_length"})
    EXPECT_NE(sentence(found[0]).find(part), std::string::npos) << sentence(found[0]);
}

TEST(TendonsTooLong, OfAPublishedLegThereAreNone) {
  const auto path = test::data_folder() / "opensim" / "rajagopal2016" / "model.osim";
  MYOID_REQUIRE_DATA(path);
  const body::BodyModel leg = body::read_osim(path);
  for (const char* coordinate : {"hip_flexion_r", "knee_angle_r", "ankle_angle_r", "hip_adduction_l"}) {
    Study study;
    study.model.file = path;
    study.model.coordinate = coordinate;
    for (const body::Muscle& muscle : leg.muscles)
      study.muscles.push_back({.name = muscle.name, .osim = {muscle.name}, .emg = muscle.name});
    EXPECT_TRUE(tendons_too_long(study, leg).empty()) << coordinate;
  }
}

}  // namespace
}  // namespace myoid::study
