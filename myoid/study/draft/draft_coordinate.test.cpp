#include "myoid/study/draft/draft_coordinate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::study {
namespace {

using ::testing::ElementsAre;

TEST(DraftCoordinate, TheElbowIsMovedByItsFourMusclesAndTheShoulderByNone) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  EXPECT_THAT(movers(arm, "elbow_flexion"), ElementsAre("BIC", "BRA", "BRD", "TRI"));
  const std::vector<std::string> names{"shoulder_flexion", "elbow_flexion"};
  EXPECT_EQ(coordinate_of_channels(arm, names, {"Biceps", "ECG"}).name, "elbow_flexion");
  EXPECT_EQ(coordinate_of_channels(arm, names, {"ECG"}).name, "");
  EXPECT_EQ(coordinate_of_channels(arm, {}, {"Biceps"}).name, "");
}

TEST(DraftCoordinate, TheElbowComesBeforeAShoulderWithMoreElectrodes) {
  const auto file = test::data_folder() / "box-lift/wu.osim";
  MYOID_REQUIRE_DATA(file);
  const CoordinateOfChannels chosen = coordinate_of_channels(body::read_osim(file), {"shoulder_plane", "elbow_flexion"},
                                                             {"Biceps", "Triceps", "Delt_med", "Delt_post", "Infra"});
  EXPECT_EQ(chosen.name, "elbow_flexion");
  EXPECT_THAT(chosen.more, ElementsAre("shoulder_plane"));
}

TEST(DraftCoordinate, IsOneThatTheRecordingMovesWithinTheModelsRange) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const std::vector<std::string> names{"shoulder_flexion", "elbow_flexion"};
  const auto recorded = [&](double shoulder_rad, double elbow_rad) {
    Eigen::MatrixXd q(2, 2);
    q << 0.1, 0.1, 0.1 + shoulder_rad, 0.1 + elbow_rad;
    return std::vector<TimeSeries>{
        {Eigen::Vector2d(0.0, 1.0), {{names[0], Unit::radian}, {names[1], Unit::radian}}, q}};
  };
  EXPECT_THAT(moved_coordinates(arm, names, recorded(0.01, 1.0)), ElementsAre("elbow_flexion"));
  EXPECT_THAT(moved_coordinates(arm, names, recorded(0.01, 0.01)), ElementsAre("shoulder_flexion", "elbow_flexion"));
  EXPECT_THAT(moved_coordinates(arm, names, {}), ElementsAre("shoulder_flexion", "elbow_flexion"));
  body::BodyModel narrow = arm;
  body::Coordinate& elbow = narrow.coordinates[static_cast<std::size_t>(narrow.coordinate_index("elbow_flexion"))];
  elbow.clamped = true;
  elbow.lower = 2.0;
  EXPECT_THAT(moved_coordinates(narrow, names, recorded(1.0, 1.0)), ElementsAre("shoulder_flexion"));
}

TEST(DraftCoordinate, ElectrodesThatNameNoSideMayBeOnTheOtherOne) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  EXPECT_EQ(same_on_the_other_side(arm, "elbow_flexion", {"Biceps"}), "");
  const auto file = test::data_folder() / "opensim/gait2354/model.osim";
  MYOID_REQUIRE_DATA(file);
  const body::BodyModel legs = body::read_osim(file);
  EXPECT_EQ(same_on_the_other_side(legs, "knee_angle_r", {"Rectus femoris", "Gastroc medialis"}), "knee_angle_l");
  EXPECT_EQ(same_on_the_other_side(legs, "knee_angle_l", {"Rectus femoris"}), "knee_angle_r");
  EXPECT_EQ(same_on_the_other_side(legs, "knee_angle_r", {"R Rectus femoris", "R Gastroc medialis"}), "");
  EXPECT_EQ(same_on_the_other_side(legs, "knee_angle_r", {"ECG"}), "") << "no muscle's name, no side to ask for";
}

TEST(DraftCoordinate, TheUsualOnesStandFirstTheOthersInTheirOrder) {
  EXPECT_THAT(usual_first({"pelvis_tilt", "ankle_angle_r", "hip_flexion_r", "knee_angle_r"}),
              ElementsAre("knee_angle_r", "ankle_angle_r", "pelvis_tilt", "hip_flexion_r"));
  EXPECT_TRUE(is_usual("r_elbow_flex"));
  EXPECT_FALSE(is_usual("hip_flexion_r"));
}

}  // namespace
}  // namespace myoid::study
