#include "myoid/opensim/projects/ceinms_rt_project.h"

#include <filesystem>
#include <map>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/read_project.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::SizeIs;
using Quantity = MuscleQuantity;

std::string rt_muscle(const std::string& name,
                      const std::string& shape,
                      const std::string& slack_m,
                      const std::string& strength) {
  return "<muscle><name>" + name + "</name><C1>-0.5</C1><C2>-0.5</C2><shapeFactor>" + shape +
         "</shapeFactor><optimalFiberLength>0.1</optimalFiberLength><pennationAngle>30</pennationAngle>"
         "<tendonSlackLength>" +
         slack_m +
         "</tendonSlackLength><maxIsometricForce>500</maxIsometricForce>"
         "<strengthCoefficient>" +
         strength + "</strengthCoefficient></muscle>\n";
}

std::string rt_subject(const std::string& muscles) {
  return "\xEF\xBB\xBF<?xml "
         "version=\"1.0\"?>\n<subject><muscleDefault><percentageChange>0.15</percentageChange></muscleDefault>"
         "<muscles>\n" +
         muscles +
         "</muscles><DoFs><DoF><name>knee_angle_r</name><muscleSequence>vas_int_r bflh_r deep_r"
         "</muscleSequence></DoF></DoFs><Channels><Channel><name>vm</name><muscleSequence>vas_int_r</muscleSequence>"
         "</Channel><Channel><name>vl</name><muscleSequence>vas_int_r</muscleSequence></Channel><Channel><name>bf</"
         "name>"
         "<muscleSequence>bflh_r</muscleSequence></Channel></Channels></subject>";
}

void write_subjects(const test::TemporaryFolder& folder) {
  fs::create_directories(folder / "CEINMS models");
  write_file(folder / "CEINMS models/one_uncalibrated.xml",
             rt_subject(rt_muscle("vas_int_r", "0.1", "0.2", "1.0") + rt_muscle("bflh_r", "0.1", "0.3", "1.0") +
                        rt_muscle("deep_r", "0.1", "0.3", "1.0")));
  write_file(folder / "CEINMS models/one_calibrated.xml",
             rt_subject(rt_muscle("vas_int_r", "-2.999", "0.21", "2.5") +
                        rt_muscle("bflh_r", "-2.999", "0.3030", "1.7") + rt_muscle("deep_r", "-2.999", "0.3", "2.5")));
}

void write_rt_trial(const test::TemporaryFolder& folder, const std::string& name) {
  const fs::path trial = folder / ("Sample data/" + name);
  fs::create_directories(trial);
  write_file(trial / "emgFilt.sto",
             "EmgsFilter \nnRows=3\nnColumns=2\nendheader\ntime\tvm\t\n1667316346.0\t0.1\t\n"
             "1667316346.5\t0.2\t\n1667316347.0\t0.2\t\n");
  write_file(trial / "ik.sto",
             "rt\nversion=1\nnRows=2\nnColumns=2\nendheader\ntime\tknee_angle_r\n1667316346.0\t-0.1\n"
             "1667316347.0\t-0.2\n");
}

// Bounds by hand: 2.5 is on the wide strength range, -2.999 on the shape's, 0.21 on 105 % of 0.2; 0.303 is 101 %.
TEST(CeinmsRtProject, WithoutACalibrationTellsBoundsByTheNumbers) {
  const test::TemporaryFolder folder;
  write_subjects(folder);
  write_rt_trial(folder, "squat 5kg");
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(project.dialect, Dialect::ceinms_rt);
  EXPECT_TRUE(project.is_calibrated);
  EXPECT_EQ(project.subject.filename(), "one_calibrated.xml");
  EXPECT_EQ(project.start.filename(), "one_uncalibrated.xml");
  const ProjectMuscle& vastus = *project.find("vas_int_r");
  EXPECT_NEAR(vastus.numbers.at(Quantity::pennation_angle).value, std::numbers::pi / 6.0, 1e-15);
  EXPECT_TRUE(vastus.numbers.at(Quantity::tendon_slack_length).is_on_bound());
  EXPECT_FALSE(project.find("bflh_r")->numbers.at(Quantity::tendon_slack_length).is_on_bound());
  EXPECT_EQ(unknowns(project, Quantity::shape_factor).all, 1U);
  EXPECT_EQ(unknowns(project, Quantity::shape_factor).on_bound, 1U);
  EXPECT_EQ(unknowns(project, Quantity::strength_coefficient).all, 2U);
  EXPECT_EQ(unknowns(project, Quantity::strength_coefficient).on_bound, 1U);
  EXPECT_EQ(unknowns(project, Quantity::tendon_slack_length).all, 2U);
  EXPECT_EQ(unknowns(project, Quantity::c1).all, 0U);
}

TEST(CeinmsRtProject, TakesTheMeanOfChannelsAndNamesMusclesWithout) {
  const test::TemporaryFolder folder;
  write_subjects(folder);
  const Project project = read_project(folder.path()).value();
  const ProjectMuscle& vastus = *project.find("vas_int_r");
  ASSERT_THAT(vastus.inputs, SizeIs(2));
  EXPECT_EQ(vastus.inputs[0].weight, 0.5);
  EXPECT_EQ(vastus.inputs[1].weight, 0.5);
  EXPECT_THAT(muscles_without_emg(project), ElementsAre("deep_r"));
  EXPECT_TRUE(knees_without_extensor(project).empty());
}

TEST(CeinmsRtProject, ReadsTrialsInFoldersWithBlanksOnUnixTimeInRadians) {
  const test::TemporaryFolder folder;
  write_subjects(folder);
  write_rt_trial(folder, "squat 5kg");
  const Project project = read_project(folder.path()).value();
  ASSERT_THAT(project.trials, SizeIs(1));
  EXPECT_EQ(project.trials[0].name, "squat 5kg");
  EXPECT_FALSE(project.trials[0].is_calibrating);
  ASSERT_THAT(project.trials[0].files, SizeIs(2));
  const TrialFile& emg = project.trials[0].files[0];
  EXPECT_EQ(emg.role, TrialRole::emg);
  EXPECT_EQ(emg.time->begin_s, 1667316346.0);
  EXPECT_NEAR(emg.rate_hz, 2.0, 1e-6);
  EXPECT_EQ(project.trials[0].files[1].is_in_degrees, false);
  int unix_times = 0;
  for (const Remark& remark : project.remarks) unix_times += remark.where == "squat 5kg" ? 1 : 0;
  EXPECT_EQ(unix_times, 1);
}

// Names in the calibration are relative to the folder of the program, which is not here.
TEST(CeinmsRtProject, FollowsACalibrationWhosePathsAreOfAnotherFolder) {
  const test::TemporaryFolder folder;
  write_subjects(folder);
  write_rt_trial(folder, "walk");
  write_rt_trial(folder, "run");
  write_file(
      folder / "cal.xml",
      "\xEF\xBB\xBF<?xml "
      "version=\"1.0\"?><simulatedAnnealing><osimFile>cfg/M/m.osim</osimFile><subjectXML>cfg/M/CEINMS "
      "models/one_uncalibrated.xml</subjectXML><calibration><objectiveFunction>"
      "StrengthCoefficients_ShapeFactor_C1_C2_TendonSlackLength_single</objectiveFunction><EMD>0.1</EMD>"
      "<dofToCalibrate><dofs>knee_angle_r</dofs></dofToCalibrate><trials><directory>cfg/M/data/</directory><trial>"
      "<trialName>walk</trialName><cropMinTimeFromZero>19</cropMinTimeFromZero><cropMaxTimeFromZero>24"
      "</cropMaxTimeFromZero></trial></trials><inputSubjectXMLName>one_uncalibrated.xml</inputSubjectXMLName>"
      "<outputSubjectXMLName>ONE_calibrated.xml</outputSubjectXMLName></calibration></simulatedAnnealing>");
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(project.subject.filename(), "one_calibrated.xml");
  EXPECT_EQ(project.common.delay_s, 0.1);
  // The objective varies each shape, C1, C2 and slack, and one strength for all that start at 1.0.
  EXPECT_EQ(unknowns(project, Quantity::c1).all, 3U);
  EXPECT_EQ(unknowns(project, Quantity::shape_factor).on_bound, 3U);
  EXPECT_EQ(unknowns(project, Quantity::strength_coefficient).all, 1U);
  // Its slack may vary by 15 %.
  EXPECT_FALSE(project.find("vas_int_r")->numbers.at(Quantity::tendon_slack_length).is_on_bound());
  ASSERT_THAT(project.trials, SizeIs(2));
  for (const ProjectTrial& trial : project.trials) EXPECT_EQ(trial.is_calibrating, trial.name == "walk");
  EXPECT_EQ(project.trials[1].used->end_s, 24.0);
}

TEST(CeinmsRtProject, RefusesADamagedSubject) {
  const test::TemporaryFolder folder;
  write_file(folder / "calibrated.xml", "<subject><muscles><muscle>");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
  write_file(folder / "calibrated.xml", "<subject><muscles/></subject>");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
}

// The folder's README: of 14 unknowns 6 lie within 1 % of their range from a bound; one joint, one of two trials.
TEST(CeinmsRtProject, OfALegHasSixOfFourteenNumbersOnBounds) {
  const fs::path data = test::data_folder() / "ceinms-rt-leg";
  MYOID_REQUIRE_DATA(data);
  const Project project = read_project(data).value();
  std::size_t all = 0, on_bound = 0;
  for (std::size_t k = 0; k < std::size(kMuscleQuantityNames); ++k) {
    const UnknownCount count = unknowns(project, static_cast<Quantity>(k));
    all += count.all;
    on_bound += count.on_bound;
  }
  EXPECT_EQ(all, 14U);
  EXPECT_EQ(on_bound, 6U);
  EXPECT_EQ(project.tendon, "stiff");
  EXPECT_EQ(project.model.filename(), "gait2392.osim");
  ASSERT_THAT(project.trials, SizeIs(2));
  EXPECT_TRUE(project.trials[0].is_calibrating);
  EXPECT_FALSE(project.trials[1].is_calibrating);
  EXPECT_THAT(project.muscles, SizeIs(92));
  EXPECT_THAT(muscles_without_emg(project), SizeIs(81));
}

// Counted by a script from the two files: of 116 muscles with a channel, 78 strengths lie on 0.5 or 2.5, and 111 fiber
// lengths and 115 slacks on 95 or 105 % of their start; any nearness from 1e-4 to 5 % of the range counts the same.
TEST(CeinmsRtProject, OfABackHas304Of348NumbersOnBounds) {
  const fs::path data = test::data_folder() / "ceinms-rt-back";
  MYOID_REQUIRE_DATA(data);
  const Project project = read_project(data).value();
  EXPECT_THAT(project.muscles, SizeIs(166));
  EXPECT_THAT(muscles_without_emg(project), SizeIs(50));
  std::map<Quantity, int> all, on_bound;
  for (const ProjectMuscle& muscle : project.muscles) {
    if (muscle.inputs.empty()) continue;
    for (const auto& [quantity, number] : muscle.numbers) {
      all[quantity] += number.unknown ? 1 : 0;
      on_bound[quantity] += number.is_on_bound() ? 1 : 0;
    }
  }
  for (const Quantity quantity :
       {Quantity::strength_coefficient, Quantity::optimal_fiber_length, Quantity::tendon_slack_length})
    EXPECT_EQ(all[quantity], 116) << choice_name(quantity);
  EXPECT_EQ(on_bound[Quantity::strength_coefficient], 78);
  EXPECT_EQ(on_bound[Quantity::optimal_fiber_length], 111);
  EXPECT_EQ(on_bound[Quantity::tendon_slack_length], 115);
  EXPECT_THAT(project.trials, SizeIs(3));
  EXPECT_EQ(project.model.filename(), "lumbarModel_scaled.osim");
}

}  // namespace
}  // namespace myoid::opensim
