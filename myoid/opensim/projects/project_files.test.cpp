#include "myoid/opensim/projects/project_files.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/calibration_plan.h"
#include "myoid/opensim/projects/project.h"
#include "myoid/opensim/projects/project_xml.h"
#include "myoid/opensim/projects/trial_files.h"

#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(RootElements, AreFoundBehindMarksDeclarationsAndComments) {
  EXPECT_THAT(root_elements("\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!-- <a> --><subject x=\"1\">\n<muscles>"),
              ElementsAre("subject", "muscles"));
  EXPECT_THAT(root_elements("<subject/>"), ElementsAre("subject"));
  EXPECT_THAT(root_elements("<subject"), ElementsAre("subject"));
  EXPECT_THAT(root_elements("<subject></subject><b/>"), ElementsAre("subject"));
  EXPECT_THAT(root_elements("<!-- never ends"), IsEmpty());
  EXPECT_THAT(root_elements(""), IsEmpty());
}

TEST(ProjectFolder, FindsFilesFromFoldersAboveAndByTheirOnlyName) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "cfg/Back/OpenSim model");
  write_file(folder / "cfg/Back/setup.xml", "<a/>");
  write_file(folder / "cfg/Back/OpenSim model/back.osim", "<a/>");
  const ProjectFolder files(folder / "cfg/Back");
  const fs::path setup = folder / "cfg/Back/setup.xml";
  EXPECT_TRUE(files.find(setup, "cfg/Back/OpenSim model/back.osim").exists);
  EXPECT_TRUE(files.find(setup, "c:\\other\\back.osim").exists);
  EXPECT_FALSE(files.find(setup, "cfg/Back/none.osim").exists);
  EXPECT_THAT(files.documents(), SizeIs(1));
  // A document in the working folder has no folder in its name.
  EXPECT_FALSE(ProjectFolder("setup.xml").find("setup.xml", "none.osim").exists);
}

TEST(ProjectFolder, PassesOverLinksHiddenFoldersAndDeepOnes) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / ".git");
  fs::create_directories(folder / "1/2/3/4/5/6/7/8");
  write_file(folder / ".git/a.xml", "<a/>");
  write_file(folder / "1/2/3/4/5/6/7/8/a.xml", "<a/>");
  write_file(folder / "1/a.xml", "<a/>");
  fs::create_directory_symlink(folder.path(), folder / "1/loop");
  EXPECT_THAT(ProjectFolder(folder.path()).files(), ElementsAre(folder / "1/a.xml"));
}

Project two_muscles() {
  Project project;
  for (const char* name : {"a", "b"})
    project.muscles.push_back({name, {{MuscleQuantity::strength_coefficient, {.value = 2.0, .start = 1.0}}}, {}});
  return project;
}

// 0.5 of 0.5 to 2 of 2 times the start.
TEST(CalibrationPlan, MultipliesRelativeRangesOfSeveralSteps) {
  Project project = two_muscles();
  const PlannedQuantity planned{
      .quantity = MuscleQuantity::strength_coefficient, .bounds = CalibrationBounds{0.5, 2.0}, .is_relative = true};
  plan(project, planned, {"a"});
  plan(project, planned, {"a", "b"});
  const ProjectNumber& first = project.muscles[0].numbers.at(MuscleQuantity::strength_coefficient);
  const ProjectNumber& second = project.muscles[1].numbers.at(MuscleQuantity::strength_coefficient);
  EXPECT_EQ(first.bounds->lower, 0.25);
  EXPECT_EQ(first.bounds->upper, 4.0);
  EXPECT_EQ(second.bounds->upper, 2.0);
  EXPECT_TRUE(second.is_on_bound());
  EXPECT_FALSE(first.is_on_bound());
  EXPECT_NE(first.unknown, second.unknown);
}

TEST(TrialTables, AreReadOnceEachAndMissingOnesNamed) {
  Project project;
  project.trials.push_back({.name = "walk", .files = {{.role = TrialRole::emg, .path = "/nowhere/emg.sto"}}});
  read_trial_tables(project);
  ASSERT_THAT(project.remarks, SizeIs(1));
  EXPECT_EQ(project.remarks[0].code, RemarkCode::refused);
  EXPECT_EQ(project.remarks[0].where, "walk");
}

TEST(ProjectXml, ReadsOneFiniteNumberOrNone) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.xml", "<a><b>1.5</b><c/><d>inf</d></a>");
  const body::OsimXml xml = read_document(folder / "a.xml");
  const pugi::xml_node root = xml.root().child("a");
  EXPECT_EQ(finite_number(xml, root, "b"), 1.5);
  EXPECT_FALSE(finite_number(xml, root, "c"));
  EXPECT_THROW((void)finite_number(xml, root, "d"), InvalidInput);
}

}  // namespace
}  // namespace myoid::opensim
