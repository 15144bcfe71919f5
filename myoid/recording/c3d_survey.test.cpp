#include "myoid/recording/c3d_survey.h"

#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_writer.h"

#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

TEST(C3dSurvey, TheLargestForceIsThatOfEveryTypeOfPlate) {
  const test::TemporaryFolder folder;
  double largest = 0.0;
  for (int i = 0; i < 1010; ++i) largest = std::max(largest, test::PlateLoad::force_n(0.001 * i).norm());
  for (int type = 1; type <= 4; ++type) {
    const auto path = folder / ("f" + std::to_string(type) + ".c3d");
    write_c3d(path, test::plate_recording(type));
    EXPECT_NEAR(survey_c3d(path).largest_force_n.at(0), largest, 1e-3) << type;
  }
}

TEST(C3dSurvey, TellsGapsExtremesAndTheLargestForce) {
  const test::TemporaryFolder folder;
  C3dFile file = test::plate_recording(2);
  file.points.row(3).setZero();
  file.points(5, 3) = -1.0F;
  file.channels.push_back({"EMG", "mV", 100.0, -0.5});
  file.analog.conservativeResize(Eigen::NoChange, 7);
  for (Eigen::Index i = 0; i < file.analog.rows(); ++i) file.analog(i, 6) = static_cast<float>(i % 11 - 5);
  write_c3d(folder / "f.c3d", file);
  const C3dSurvey survey = survey_c3d(folder / "f.c3d");
  EXPECT_EQ(survey.frames, 101);
  EXPECT_EQ(survey.missing_frames, std::vector<Eigen::Index>{2});
  EXPECT_EQ(survey.lowest[6], (5.0 - 100.0) * -0.5);
  EXPECT_EQ(survey.highest[6], (-5.0 - 100.0) * -0.5);
  double largest = 0.0;
  for (int i = 0; i < 1010; ++i) largest = std::max(largest, test::PlateLoad::force_n(0.001 * i).norm());
  ASSERT_EQ(survey.largest_force_n.size(), 1U);
  EXPECT_NEAR(survey.largest_force_n[0], largest, 1e-3);  // reals of 24 bits
  EXPECT_EQ(survey.file.points.size(), 0);
}

}  // namespace
}  // namespace myoid::recording
