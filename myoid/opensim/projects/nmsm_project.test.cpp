#include "myoid/opensim/projects/nmsm_project.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/read_project.h"

#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::SizeIs;
using Quantity = MuscleQuantity;

std::string osimx(const std::string& vastus_more = "") {
  return "<?xml version=\"1.0\"?>\n<NMSMPipelineDocument Version=\"1\">\n<OsimxModel name=\"m\">\n"
         "<associated_osim_model>m.osim</associated_osim_model>\n<RCNLMuscleSet>\n<objects>\n"
         "<RCNLMuscle name=\"vasmed_r\"><electromechanical_delay>0.5</electromechanical_delay>"
         "<activation_time_constant>3.5</activation_time_constant><emg_scale_factor>0.5</emg_scale_factor>"
         "<optimal_fiber_length>0.14</optimal_fiber_length><tendon_slack_length>0.2</tendon_slack_length>" +
         vastus_more +
         "</RCNLMuscle>\n<RCNLMuscle name=\"psoas_r\"><electromechanical_delay>0.5</electromechanical_delay>"
         "<optimal_fiber_length>0.11</optimal_fiber_length></RCNLMuscle>\n</objects>\n<groups/>\n</RCNLMuscleSet>\n"
         "</OsimxModel>\n</NMSMPipelineDocument>\n";
}

void write_nmsm_project(const test::TemporaryFolder& folder) {
  write_file(
      folder / "m.osim",
      "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><ForceSet><objects>"
      "<Thelen2003Muscle name=\"vasmed_r\"><optimal_fiber_length>0.1</optimal_fiber_length><tendon_slack_length>0.2"
      "</tendon_slack_length></Thelen2003Muscle><Thelen2003Muscle name=\"psoas_r\"><optimal_fiber_length>0.1"
      "</optimal_fiber_length></Thelen2003Muscle></objects><groups><ObjectGroup name=\"VM\"><members>vasmed_r"
      "</members></ObjectGroup><ObjectGroup name=\"deep\"><members>psoas_r</members></ObjectGroup></groups>"
      "</ForceSet></Model></OpenSimDocument>");
  write_file(
      folder / "settings.xml",
      "<NMSMPipelineDocument><MuscleTendonPersonalizationTool><input_model_file>m.osim</input_model_file>"
      "<data_directory>preprocessed</data_directory><coordinate_list>knee_angle_r</coordinate_list>"
      "<collected_emg_channel_muscle_groups>VM</collected_emg_channel_muscle_groups>"
      "<missing_emg_channel_muscle_groups>deep</missing_emg_channel_muscle_groups>"
      "<MTPTaskList><MTPTask><is_enabled>true</is_enabled><optimize_electromechanical_delays>true"
      "</optimize_electromechanical_delays><muscle_specific_electromechanical_delays>false"
      "</muscle_specific_electromechanical_delays><optimize_activation_time_constants>true"
      "</optimize_activation_time_constants><optimize_optimal_fiber_lengths>true</optimize_optimal_fiber_lengths>"
      "<optimize_tendon_slack_lengths>false</optimize_tendon_slack_lengths><optimize_emg_scale_factors>false"
      "</optimize_emg_scale_factors>"
      "</MTPTask></MTPTaskList></MuscleTendonPersonalizationTool></NMSMPipelineDocument>");
  fs::create_directories(folder / "results");
  write_file(folder / "results/m_mtp.osimx", osimx());
  const auto table = [](double begin_s) {
    return "t\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\ntime\tVM\n" + std::to_string(begin_s) +
           "\t0.1\n1.0\t0.2\n";
  };
  for (const char* part : {"EMGData", "IDData", "IKData", "MAData/gait_1"})
    fs::create_directories(folder / (std::string("preprocessed/") + part));
  write_file(folder / "preprocessed/EMGData/gait_1.sto", table(-0.2));
  write_file(folder / "preprocessed/IDData/gait_1.sto", table(0.0));
  write_file(folder / "preprocessed/IKData/gait_1.sto", table(0.0));
  for (const char* name : {"Length", "Velocity", "MomentArm_knee_angle_r", "MomentArm_knee_angle_r_beta"})
    write_file(folder / (std::string("preprocessed/MAData/gait_1/gait_1_") + name + ".sto"), table(0.0));
}

TEST(NmsmProject, HasStoredDelaysByTenAndTimeConstantsByAHundred) {
  const test::TemporaryFolder folder;
  write_nmsm_project(folder);
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(project.dialect, Dialect::nmsm);
  const ProjectMuscle& vastus = *project.find("vasmed_r");
  EXPECT_NEAR(vastus.numbers.at(Quantity::delay).value, 0.05, 1e-15);
  EXPECT_NEAR(vastus.numbers.at(Quantity::activation_time).value, 0.035, 1e-15);
  // 35 ms is the optimizer's greatest time constant, and 0.14 is 1.4 times the model's 0.1.
  EXPECT_TRUE(vastus.numbers.at(Quantity::activation_time).is_on_bound());
  EXPECT_TRUE(vastus.numbers.at(Quantity::optimal_fiber_length).is_on_bound());
  EXPECT_FALSE(project.find("psoas_r")->numbers.at(Quantity::optimal_fiber_length).is_on_bound());
  EXPECT_EQ(unknowns(project, Quantity::delay).all, 1U);  // one for all muscles
  EXPECT_EQ(unknowns(project, Quantity::optimal_fiber_length).all, 2U);
  EXPECT_EQ(unknowns(project, Quantity::tendon_slack_length).all, 0U);  // the task leaves it
  EXPECT_EQ(unknowns(project, Quantity::emg_scale).all, 0U);
}

TEST(NmsmProject, TakesChannelsFromTheModelsGroupsAndLeavesOtherCoordinates) {
  const test::TemporaryFolder folder;
  write_nmsm_project(folder);
  const Project project = read_project(folder / "settings.xml").value();
  EXPECT_EQ(project.find("vasmed_r")->inputs.at(0).channel, "VM");
  EXPECT_THAT(muscles_without_emg(project), ElementsAre("psoas_r"));
  EXPECT_THAT(project.synthesized, ElementsAre("psoas_r"));
  ASSERT_THAT(project.trials, SizeIs(1));
  int arms = 0;
  for (const TrialFile& file : project.trials[0].files) {
    arms += file.role == TrialRole::moment_arms ? 1 : 0;
    if (file.role == TrialRole::emg) {
      EXPECT_NEAR(file.time->begin_s, -0.2, 1e-12);
    }
    if (file.role == TrialRole::torques) {
      EXPECT_EQ(file.time->begin_s, 0.0);
    }
  }
  EXPECT_EQ(arms, 1);
}

TEST(NmsmProject, TellsTheMusclesOfAJointByTheirMomentArms) {
  const test::TemporaryFolder folder;
  write_nmsm_project(folder);
  EXPECT_TRUE(read_project(folder.path())->dofs.at(0).muscles.empty());  // the arms are of no muscle
  write_file(folder / "preprocessed/MAData/gait_1/gait_1_MomentArm_knee_angle_r.sto",
             "t\nversion=1\nnRows=2\nnColumns=3\ninDegrees=no\nendheader\ntime\tvasmed_r\tpsoas_r\n0.0\t0\t0\n1.0\t-0."
             "04\t0\n");
  const Project project = read_project(folder.path()).value();
  EXPECT_THAT(project.dofs.at(0).muscles, ElementsAre("vasmed_r"));
  EXPECT_TRUE(knees_without_extensor(project).empty());
}

// The pipeline takes a number as varied unless the task says false.
TEST(NmsmProject, ATaskThatSaysNothingVariesEveryNumber) {
  const test::TemporaryFolder folder;
  write_nmsm_project(folder);
  write_file(folder / "settings.xml",
             "<NMSMPipelineDocument Version=\"1.5.0\"><MuscleTendonPersonalizationTool><input_model_file>m.osim"
             "</input_model_file><coordinate_list>knee_angle_r</coordinate_list><MTPTaskList><MTPTask><is_enabled>true"
             "</is_enabled><optimize_emg_scale_factors>false</optimize_emg_scale_factors></MTPTask></MTPTaskList>"
             "</MuscleTendonPersonalizationTool></NMSMPipelineDocument>");
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(unknowns(project, Quantity::optimal_fiber_length).all, 2U);
  EXPECT_EQ(unknowns(project, Quantity::tendon_slack_length).all, 1U);  // the .osimx holds one
  EXPECT_EQ(unknowns(project, Quantity::delay).all, 2U);
  EXPECT_EQ(unknowns(project, Quantity::emg_scale).all, 0U);
}

TEST(NmsmProject, AnEarlierVersionHasOtherNamesAndMayHaveTheDataBesideItsSettings) {
  const test::TemporaryFolder folder;
  write_nmsm_project(folder);
  fs::rename(folder / "preprocessed/EMGData", folder / "EMGData");
  write_file(folder / "settings.xml",
             "<OpenSimDocument Version=\"40000\"><MuscleTendonPersonalizationTool><input_model_file>m.osim"
             "</input_model_file><data_directory></data_directory><coordinate_list>knee_angle_r</coordinate_list>"
             "<MuscleTendonPersonalizationTaskList><MuscleTendonPersonalizationTask><is_enabled>true</is_enabled>"
             "<optimize_emg_scale_factors>false</optimize_emg_scale_factors></MuscleTendonPersonalizationTask>"
             "</MuscleTendonPersonalizationTaskList></MuscleTendonPersonalizationTool></OpenSimDocument>");
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(unknowns(project, Quantity::optimal_fiber_length).all, 2U);
  EXPECT_EQ(unknowns(project, Quantity::emg_scale).all, 0U);
  EXPECT_FALSE(project.trials.empty());
}

TEST(NmsmProject, MusclesStandInObjectsOrDirectlyInTheirSet) {
  for (const auto& [set, inside] :
       {std::pair("RCNLMuscleSet", true), std::pair("RCNLMuscleSet", false), std::pair("MTPMuscleSet", true)}) {
    std::string text = osimx();
    for (const std::string tag : {"<objects>\n", "</objects>\n"})
      if (!inside) text.erase(text.find(tag), tag.size());
    for (std::size_t at = 0; (at = text.find("RCNLMuscleSet", at)) != std::string::npos; ++at)
      text.replace(at, 13, set);
    const test::TemporaryFolder folder;
    write_file(folder / "a.osimx", text);
    const Project project = read_project(folder / "a.osimx").value();
    EXPECT_THAT(project.muscles, SizeIs(2)) << set;
    EXPECT_TRUE(project.is_calibrated);
    for (const Remark& remark : project.remarks) EXPECT_NE(remark.about, "RCNLMuscle");
  }
}

TEST(NmsmProject, IsReadFromAnOsimxAlone) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.osimx", osimx("<colour>1</colour>"));
  const Project project = read_project(folder / "a.osimx").value();
  EXPECT_THAT(project.muscles, SizeIs(2));
  EXPECT_EQ(unknowns(project, Quantity::delay).all, 2U);
  EXPECT_FALSE(project.find("vasmed_r")->numbers.at(Quantity::optimal_fiber_length).bounds);  // no start
  EXPECT_TRUE(knees_without_extensor(project).empty());
  int colours = 0;
  for (const Remark& remark : project.remarks) colours += remark.about == "colour" ? 1 : 0;
  EXPECT_EQ(colours, 1);
}

TEST(NmsmProject, RefusesDamagedNumbersAndAMissingModel) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.osimx", osimx("<max_isometric_force>-3</max_isometric_force>"));
  EXPECT_THROW((void)read_project(folder / "a.osimx"), ReadError);
  write_file(folder / "a.osimx", osimx("<activation_nonlinearity_constant>nan</activation_nonlinearity_constant>"));
  EXPECT_THROW((void)read_project(folder / "a.osimx"), ReadError);
  write_nmsm_project(folder);
  fs::remove(folder / "a.osimx");
  fs::remove(folder / "m.osim");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
}

}  // namespace
}  // namespace myoid::opensim
