#include "myoid/opensim/projects/mrs_project.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/model_parts.h"
#include "myoid/opensim/projects/read_project.h"

#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::SizeIs;
using Quantity = MuscleQuantity;

std::string mrs_script(const std::string& more = "") {
  return "clear all;\nDataPath = [pwd '\\Data'];\n"
         "Misc.IKfile = {fullfile(DataPath,'walk_IK.mot'); fullfile(DataPath,'run_IK.mot')}; % {'old.mot'}\n"
         "Misc.IDfile = {fullfile(DataPath,'walk_ID.sto'); fullfile(DataPath,'run_ID.sto')};\n"
         "Misc.EMGfile = {fullfile(DataPath,'walk_EMG.mot')};\n"
         "model_path = fullfile(DataPath,'m.osim');\n"
         "time = [0.2 0.8;  % walk\n    0 9999];\n"
         "Misc.DofNames_Input={'ankle_angle_r','knee_angle_r'};%,'hip_flexion_r'};\n"
         "Misc.EMGheaders = {'time','sol_r', ...\n    'gas_r','tib_r'};\n"
         "Misc.EMGSelection = {'sol_r','gas_r'};\n"
         "Misc.EMG_MuscleCopies = {'gas_r','gaslat_r'};\n"
         "Misc.MuscleNames_Input = {'sol_r','gas_r','gaslat_r','tib_r'};\n"
         "Misc.Estimate_TendonStifness = {'sol_r';'gas_r'};\nMisc.lb_kT_scaling = 0.1;\nMisc.ub_kT_scaling = 2.2;\n"
         "Misc.Coupled_TendonStifness = Misc.Estimate_TendonStifness;\n"
         "Misc.Estimate_OptFL = {'sol_r';'gas_r';'tib_r'};\nMisc.lb_lMo_scaling = 0.5;\nMisc.ub_lMo_scaling = 1.5;\n"
         "Misc.lb_lTs_scaling = 0.9;\nMisc.ub_lTs_scaling = 1.1;\nMisc.Coupled_fiber_length = {'sol_r';'gas_r'};\n"
         "Misc.EMGconstr = 1;\nMisc.BoundsScaleEMG = [0.01 3];\n" +
         more + "[Results,DatStore] = MuscleTendonEstimator(model_path,time,Out_path,Misc);\n";
}

std::string two_columns(const std::string& columns, const std::string& row) {
  return "t\nversion=1\nnRows=3\nnColumns=3\ninDegrees=yes\nendheader\ntime\t" + columns + "\n0.0\t" + row + "\n0.5\t" +
         row + "\n1.0\t" + row + "\n";
}

void write_mrs_project(const test::TemporaryFolder& folder, const std::string& more = "") {
  fs::create_directories(folder / "Data");
  write_file(folder / "main.m", mrs_script(more));
  const auto muscle = [](const std::string& name, const char* fiber_m) {
    return "<Thelen2003Muscle name=\"" + name + "\"><optimal_fiber_length>" + fiber_m +
           "</optimal_fiber_length><tendon_slack_length>0.2</tendon_slack_length><max_isometric_force>1000"
           "</max_isometric_force></Thelen2003Muscle>";
  };
  write_file(folder / "Data/m.osim", "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><ForceSet><objects>" +
                                         muscle("sol_r", "0.05") + muscle("gas_r", "0.06") +
                                         muscle("gaslat_r", "0.06") + muscle("tib_r", "0.1") +
                                         "</objects></ForceSet></Model></OpenSimDocument>");
  for (const char* name : {"walk_IK.mot", "run_IK.mot"})
    write_file(folder / (std::string("Data/") + name), two_columns("ankle_angle_r\tknee_angle_r", "5\t10"));
  for (const char* name : {"walk_ID.sto", "run_ID.sto"})
    write_file(folder / (std::string("Data/") + name),
               two_columns("ankle_angle_r_moment\tknee_angle_r_moment", "5\t10"));
  write_file(folder / "Data/walk_EMG.mot", two_columns("sol_r\tgas_r", "0.1\t0.2"));
}

const ProjectNumber& factor(const Project& project, const std::string& muscle, Quantity quantity) {
  return project.find(muscle)->numbers.at(quantity);
}

TEST(MrsProject, IsReadFromItsScriptWithoutRunningIt) {
  const test::TemporaryFolder folder;
  write_mrs_project(folder);
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(project.dialect, Dialect::mrs);
  EXPECT_EQ(project.set_up.filename(), "main.m");
  EXPECT_EQ(project.model.filename(), "m.osim");
  EXPECT_FALSE(project.is_calibrated);
  ASSERT_THAT(project.dofs, SizeIs(2));  // the comment behind the list adds none
  EXPECT_EQ(project.dofs[1].name, "knee_angle_r");
  ASSERT_THAT(project.trials, SizeIs(2));
  EXPECT_EQ(project.trials[0].name, "walk_IK");
  EXPECT_EQ(project.trials[0].used->begin_s, 0.2);
  EXPECT_EQ(project.trials[0].used->end_s, 0.8);
  EXPECT_EQ(project.trials[1].used->end_s, 9999.0);
  EXPECT_THAT(project.trials[0].files, SizeIs(3));
  for (const ProjectTrial& trial : project.trials)
    for (const TrialFile& file : trial.files) {
      EXPECT_TRUE(file.exists) << file.path;
      ASSERT_TRUE(file.time) << file.path;
      if (file.role == TrialRole::motion) {
        EXPECT_EQ(file.is_in_degrees, true);
      }
    }
  EXPECT_THAT(project.remarks, ElementsAre(Field(&Remark::about, "emg")));  // of one trial of two
}

TEST(MrsProject, TellsChannelsCopiesAndMusclesWithoutEmg) {
  const test::TemporaryFolder folder;
  write_mrs_project(folder);
  const Project project = read_project(folder / "main.m").value();
  EXPECT_EQ(project.find("gas_r")->inputs.at(0).channel, "gas_r");
  EXPECT_EQ(project.find("gaslat_r")->inputs.at(0).channel, "gas_r");
  EXPECT_THAT(muscles_without_emg(project), ElementsAre("tib_r"));
}

TEST(MrsProject, TakesChannelsByTheOrderThatTheirHeadersTell) {
  const test::TemporaryFolder folder;
  write_mrs_project(folder);  // headers: time, sol_r, gas_r, tib_r
  const auto channels = [&](const std::string& columns) {
    write_file(folder / "Data/walk_EMG.mot", two_columns(columns, "0.1\t0.2"));
    const Project project = read_project(folder.path()).value();
    return std::vector<std::string>{project.find("sol_r")->inputs.at(0).channel,
                                    project.find("gaslat_r")->inputs.at(0).channel};
  };
  EXPECT_THAT(channels("sol_r\tgas_r"), ElementsAre("sol_r", "gas_r"));
  EXPECT_THAT(channels("ch1\tch2"), ElementsAre("ch1", "ch2"));
  EXPECT_THAT(channels("gas_r\tsol_r"), ElementsAre("gas_r", "sol_r"));
  write_file(folder / "Data/run_EMG.mot", two_columns("sol_r\tgas_r", "0.1\t0.2"));
  write_file(folder / "main.m",
             mrs_script("Misc.EMGfile = {fullfile(DataPath,'walk_EMG.mot'); fullfile(DataPath,'run_EMG.mot')};\n"));
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
}

TEST(MrsProject, CountsWhatIsEstimatedWithBoundsAndCouplings) {
  const test::TemporaryFolder folder;
  write_mrs_project(folder);
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(unknowns(project, Quantity::tendon_stiffness).all, 1U);      // both muscles share it
  EXPECT_EQ(unknowns(project, Quantity::optimal_fiber_length).all, 2U);  // sol with gas, and tib
  EXPECT_EQ(unknowns(project, Quantity::tendon_slack_length).all, 3U);
  EXPECT_EQ(unknowns(project, Quantity::emg_scale).all, 2U);
  const ProjectNumber& fiber = factor(project, "tib_r", Quantity::optimal_fiber_length);
  EXPECT_EQ(fiber.start, 0.1);
  EXPECT_NEAR(fiber.bounds->lower, 0.05, 1e-15);
  EXPECT_NEAR(fiber.bounds->upper, 0.15, 1e-15);
  EXPECT_EQ(factor(project, "sol_r", Quantity::tendon_stiffness).bounds->upper, 2.2);
  EXPECT_EQ(factor(project, "sol_r", Quantity::emg_scale).bounds->upper, 3.0);
  EXPECT_FALSE(factor(project, "gaslat_r", Quantity::optimal_fiber_length).unknown);
}

TEST(MrsProject, TakesATableOfNamesInPlaceOfAComputedMapping) {
  const test::TemporaryFolder folder;
  const std::string computed = "Misc.EMGSelection = getSelection(Misc);\ntime(1,:) = [IK.data(1,1) 2];\n";
  write_mrs_project(folder, computed);
  Project project = read_project(folder.path()).value();
  EXPECT_FALSE(project.has_mapping);
  EXPECT_FALSE(project.trials[0].used);
  EXPECT_THAT(project.remarks,
              Contains(AllOf(Field(&Remark::about, "Misc.EMGSelection"), Field(&Remark::value, 27.0))));
  EXPECT_THAT(project.remarks, Contains(AllOf(Field(&Remark::about, "time"), Field(&Remark::value, 28.0))));
  EXPECT_THAT(project.remarks, Contains(Field(&Remark::about, "muscles.csv")));
  write_file(folder / "muscles.csv", "muscle,emg\nsol_r,ch 1\ntib_r,ch 2\ngas_r,\n");
  project = read_project(folder.path()).value();
  EXPECT_TRUE(project.has_mapping);
  EXPECT_EQ(project.find("tib_r")->inputs.at(0).channel, "ch 2");
  EXPECT_THAT(muscles_without_emg(project), ElementsAre("gas_r", "gaslat_r"));
  write_file(folder / "muscles.csv", "name,channel\nsol_r,ch 1\n");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
}

TEST(MrsProject, NamesNegativeEmgAndAbsentMusclesAndFiles) {
  const test::TemporaryFolder folder;
  write_mrs_project(folder, "Misc.EMGSelection = {'sol_r','vas_r'};\n");
  write_file(folder / "Data/walk_EMG.mot", two_columns("sol_r\tgas_r", "0.1\t-0.25"));
  fs::remove(folder / "Data/run_ID.sto");
  const Project project = read_project(folder.path()).value();
  EXPECT_THAT(project.remarks, Contains(Field(&Remark::code, RemarkCode::emg_envelope)));
  EXPECT_THAT(project.remarks, Contains(Field(&Remark::code, RemarkCode::refused)));
  EXPECT_THAT(project.remarks, Contains(Field(&Remark::about, "vas_r")));
  EXPECT_EQ(project.find("vas_r"), nullptr);  // a study of it would have a muscle without geometry
  EXPECT_THAT(project.remarks, Contains(Field(&Remark::about, "Misc.EMGheaders")));
}

TEST(MrsProject, TakesTheModelsMusclesWhereNoneAreNamed) {
  const test::TemporaryFolder folder;
  write_mrs_project(folder, "Misc.MuscleNames_Input = {};\n");
  EXPECT_THAT(read_project(folder.path())->muscles, SizeIs(4));
  write_mrs_project(folder, "model_path = fullfile(DataPath, 'none.osim');\n");
  const Project project = read_project(folder.path()).value();
  EXPECT_TRUE(project.model.empty());
  EXPECT_FALSE(project.find("sol_r")->numbers.contains(Quantity::optimal_fiber_length));
}

TEST(MrsProject, IsNoOtherScriptOfMatlab) {
  const test::TemporaryFolder folder;
  write_file(folder / "plot.m", "Misc.IKfile = 'a.mot';\nplot(1:3)\n");
  write_file(folder / "other.m", "% solveMuscleRedundancy\nx = 1;\n");
  write_file(folder / "binary.m", std::string("\0\1\2", 3));
  EXPECT_FALSE(read_project(folder.path()));
  EXPECT_FALSE(is_mrs_script(folder / "none.m"));
}

TEST(ModelParts, AreTheMusclesOfTheForceSet) {
  const test::TemporaryFolder folder;
  write_mrs_project(folder);
  const ModelParts parts = read_model_parts(folder / "Data/m.osim");
  ASSERT_THAT(parts.muscles, SizeIs(4));
  EXPECT_EQ(parts.muscles[3].numbers.at(Quantity::max_isometric_force).value, 1000.0);
}

}  // namespace
}  // namespace myoid::opensim
