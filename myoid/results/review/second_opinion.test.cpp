#include "myoid/results/review/second_opinion.h"

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/read_project.h"
#include "myoid/results/review/project_study.h"
#include "myoid/run/run_study.h"
#include "myoid/study/study_text.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

// An independent computation in numpy, from the source of CEINMS-RT, is in the data's README: R2 0.648 and 0.482,
// errors of 17.4 and 20.8 N m. The torque has a peak of 100 N m, of which 2 % are allowed.
TEST(SecondOpinion, RecomputesTheTorqueOfAPublishedCalibration) {
  const std::filesystem::path data = test::data_folder() / "ceinms-rt-leg";
  MYOID_REQUIRE_DATA(data);
  const test::TemporaryFolder folder;
  opensim::Project project = opensim::read_project(data).value();
  const std::vector<std::string> joints = reviewed_joints(project);
  ASSERT_EQ(joints, std::vector<std::string>{"ankle_angle_r"});
  const ProjectStudy made = study_of_project(project, joints, folder.path());
  EXPECT_EQ(made.study.muscles.size(), 4U);
  write_file(made.study.file, study::study_toml(made.study));
  const SecondOpinion opinion = second_opinion(std::move(project), joints, run::study_data(made.study));
  ASSERT_EQ(opinion.torques.size(), 2U);
  EXPECT_TRUE(opinion.torques[0].is_calibrating);
  EXPECT_FALSE(opinion.torques[1].is_calibrating);
  EXPECT_NEAR(opinion.torques[0].theirs->rmse_nm(), 17.4, 2.0);
  EXPECT_NEAR(opinion.torques[1].theirs->rmse_nm(), 20.8, 2.0);
  EXPECT_NEAR(opinion.torques[0].theirs->r2(), 0.648, 0.03);
  EXPECT_NEAR(opinion.torques[1].theirs->r2(), 0.482, 0.03);
  EXPECT_EQ(opinion.unknowns, 14U);
  EXPECT_EQ(opinion.on_bound, 6U);
}

}  // namespace
}  // namespace myoid::results
