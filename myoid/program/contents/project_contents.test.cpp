#include "myoid/program/contents/project_contents.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/program/contents/contents_text.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

TEST(ProjectContents, AreNoneOfAFolderWithoutAProject) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(project_contents(folder.path()));
}

// A subject of CEINMS alone: nothing tells what was calibrated.
TEST(ProjectContents, TellASubjectAlone) {
  const test::TemporaryFolder folder;
  write_file(folder / "s.xml",
             "<subject><mtuSet><mtu><name>a</name><optimalFibreLength>0.1</optimalFibreLength><tendonSlackLength>0.2"
             "</tendonSlackLength><maxIsometricForce>100</maxIsometricForce></mtu></mtuSet></subject>");
  const nlohmann::ordered_json contents = project_contents(folder / "s.xml").value();
  EXPECT_EQ(contents.at("dialect"), "CEINMS");
  EXPECT_EQ(contents.at("muscle_count"), 1);
  EXPECT_EQ(contents.at("calibrated_numbers"), 0);
  EXPECT_FALSE(contents.contains("muscles_without_emg"));
}

// A table that is cut off stands among the notes, before lesser ones, and among the trial's files that were not read.
TEST(ProjectContents, TellACutTableAndTheWeightsOfAHybridRun) {
  const test::TemporaryFolder folder;
  write_file(folder / "s.xml",
             "<subject><mtuSet><mtu><name>a</name><optimalFibreLength>0.1</optimalFibreLength><tendonSlackLength>0.2"
             "</tendonSlackLength><maxIsometricForce>100</maxIsometricForce></mtu></mtuSet></subject>");
  write_file(folder / "run.xml", "<ceinms><subjectFile>s.xml</subjectFile></ceinms>");
  write_file(
      folder / "execution.xml",
      "<execution><NMSmodel><type><hybrid><alpha>1</alpha><beta>2</beta><gamma>3</gamma></hybrid></type></NMSmodel>"
      "</execution>");
  write_file(folder / "walk.xml",
             "<inputData><excitationsFile>emg.mot</excitationsFile><externalTorquesFile>id.sto</externalTorquesFile>"
             "</inputData>");
  write_file(folder / "emg.mot", "emg\nversion=1\nnRows=9\nnColumns=2\ninDegrees=no\nendh");
  write_file(folder / "id.sto",
             "id\nversion=1\nnRows=9\nnColumns=2\ninDegrees=no\nendheader\ntime\tknee\n0\t1\n0.1\t2\n");
  const nlohmann::ordered_json contents = project_contents(folder.path()).value();
  EXPECT_EQ(contents.at("hybrid").at("gamma"), 3.0);
  EXPECT_EQ(contents.at("trials").at(0).at("not_read"), "emg");
  EXPECT_EQ(contents.at("notes").size(), 2U);  // of the EMG, whose header is cut, and of the torques, with 2 rows of 9
}

// The README of the data: 14 numbers, 6 on a bound; the text lists them by muscle and parameter.
TEST(ProjectContents, CountTheNumbersOfALeg) {
  const fs::path data = test::data_folder() / "ceinms-rt-leg";
  MYOID_REQUIRE_DATA(data);
  const nlohmann::ordered_json contents = project_contents(data).value();
  EXPECT_EQ(contents.at("dialect"), "CEINMS-RT");
  EXPECT_EQ(contents.at("calibrated_numbers"), 14);
  EXPECT_EQ(contents.at("numbers_on_bound"), 6);
  EXPECT_EQ(contents.at("first_on_bound").size(), 6U);
  EXPECT_EQ(contents.at("muscle_count"), 92);
  EXPECT_EQ(contents.at("muscles_without_emg").size(), 81U);
  EXPECT_EQ(contents.at("trials").size(), 2U);
  EXPECT_FALSE(contents.contains("knees_without_extensor"));
  const std::string text = contents_text(contents);
  EXPECT_THAT(text, testing::HasSubstr("numbers on bound: 6\n"));
  EXPECT_THAT(text, testing::HasSubstr("first on bound (6):\n"));
}

}  // namespace
}  // namespace myoid::program
