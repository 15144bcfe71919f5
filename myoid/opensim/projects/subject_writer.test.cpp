#include "myoid/opensim/projects/subject_writer.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/ceinms_subject.h"
#include "myoid/opensim/projects/osimx_file.h"
#include "myoid/opensim/projects/project_xml.h"
#include "myoid/opensim/projects/subject_words.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

using Quantity = MuscleQuantity;
using ::testing::ElementsAre;

/// Two muscles with every number; no number has few digits.
Project every_number(Dialect dialect) {
  Project project{.dialect = dialect,
                  .start = "before.xml",
                  .model = "../models/a & b.osim",
                  .is_calibrated = true,
                  .common = {.delay_s = 0.1 / 3.0, .damping = 0.1 / 7.0, .percentage_change = 0.1 / 9.0},
                  .curves = {{"activeForceLength", {0.0, 1.0 / 3.0, 2.0}, {0.0, 1.0 / 7.0, 1e-17}}},
                  .dofs = {{"knee_angle_r", {"vas_r", "bf_r"}, true}, {"hip_flexion_r", {}, true}},
                  .has_mapping = true};
  for (const char* name : {"vas_r", "bf_r"}) {
    ProjectMuscle muscle{name, {}, {}};
    for (std::size_t k = 0; k < std::size(kMuscleQuantityNames); ++k)
      muscle.numbers[static_cast<Quantity>(k)].value = 0.1 * static_cast<double>(k + 1) / 7.0;
    project.muscles.push_back(muscle);
  }
  project.muscles[0].inputs = {{"VL", 0.5}, {"VM", 0.5}};
  project.muscles[1].inputs = {{"BF long", 1.0}};
  return project;
}

CeinmsSubject written(const test::TemporaryFolder& folder, const Project& project) {
  write_file(folder / "s.xml", ceinms_subject_text(project));
  return read_ceinms_subject(folder / "s.xml");
}

TEST(SubjectWriter, IsReadBackWithTheSameValuesInBothDialects) {
  const test::TemporaryFolder folder;
  for (const Dialect dialect : {Dialect::ceinms, Dialect::ceinms_rt}) {
    const Project project = every_number(dialect);
    const CeinmsSubject read = written(folder, project);
    EXPECT_EQ(read.dialect, dialect);
    EXPECT_THAT(read.remarks, testing::IsEmpty());
    EXPECT_EQ(read.common.damping, project.common.damping);
    EXPECT_EQ(read.common.percentage_change, project.common.percentage_change);
    ASSERT_EQ(read.curves.size(), 1U);
    EXPECT_EQ(read.curves[0].x, project.curves[0].x);
    EXPECT_EQ(read.curves[0].y, project.curves[0].y);
    ASSERT_EQ(read.muscles.size(), 2U);
    for (std::size_t m = 0; m < 2; ++m) {
      for (const NumberWord& word : subject_words(dialect).numbers) {
        const double value = project.muscles[m].numbers.at(word.quantity).value;
        EXPECT_NEAR(read.muscles[m].numbers.at(word.quantity).value, value, 1e-15 * std::abs(value)) << word.element;
      }
    }
    EXPECT_THAT(read.dofs[0].muscles, ElementsAre("vas_r", "bf_r"));
  }
}

// The manual of CEINMS: <calibrated> with the file it began from and the list of calibrations.
TEST(SubjectWriter, SaysWhetherTheSubjectIsCalibrated) {
  const test::TemporaryFolder folder;
  Project project = every_number(Dialect::ceinms);
  CeinmsSubject read = written(folder, project);
  EXPECT_TRUE(read.says_calibrated);
  EXPECT_EQ(read.start_file, "before.xml");
  EXPECT_EQ(read.model_file, "../models/a & b.osim");
  EXPECT_EQ(read.common.delay_s, project.common.delay_s);
  project.is_calibrated = false;
  read = written(folder, project);
  EXPECT_FALSE(read.says_calibrated);
  const body::OsimXml xml = read_document(folder / "s.xml");
  EXPECT_FALSE(
      xml.word(xml.root().child("subject").child("calibrationInfo").child("uncalibrated"), "subjectID").empty());
}

TEST(SubjectWriter, GivesAMuscleItsOwnDelayWhereItDiffers) {
  const test::TemporaryFolder folder;
  Project project = every_number(Dialect::ceinms);
  project.muscles[0].numbers[Quantity::delay].value = *project.common.delay_s;
  (void)written(folder, project);
  const body::OsimXml xml = read_document(folder / "s.xml");
  const pugi::xml_node first = xml.root().child("subject").child("mtuSet").child("mtu");
  EXPECT_FALSE(first.child("emDelay"));
  EXPECT_TRUE(first.next_sibling("mtu").child("emDelay"));
}

TEST(SubjectWriter, HasAChannelForEachInputOfCeinmsRt) {
  const test::TemporaryFolder folder;
  const CeinmsSubject read = written(folder, every_number(Dialect::ceinms_rt));
  EXPECT_TRUE(read.has_channels);
  ASSERT_EQ(read.muscles[0].inputs.size(), 2U);
  EXPECT_EQ(read.muscles[0].inputs[0].weight, 0.5);
  EXPECT_EQ(read.muscles[1].inputs[0].channel, "BF long");
}

TEST(SubjectWriter, RefusesANameWithBlanks) {
  Project project = every_number(Dialect::ceinms);
  project.muscles[0].name = "vas r";
  EXPECT_THROW((void)ceinms_subject_text(project), InvalidInput);
}

TEST(SubjectWriter, WritesRealSubjectsAgainWithTheSameValues) {
  const std::filesystem::path data = test::data_folder() / "ceinms-rt-leg";
  MYOID_REQUIRE_DATA(data);
  const test::TemporaryFolder folder;
  for (const char* name : {"subjectCalibrated.xml", "subjectUncalibrated.xml"}) {
    const CeinmsSubject real = read_ceinms_subject(data / name);
    const CeinmsSubject again = written(folder, project_of(real));
    ASSERT_EQ(again.muscles.size(), real.muscles.size());
    for (std::size_t m = 0; m < real.muscles.size(); ++m) {
      EXPECT_EQ(again.muscles[m].name, real.muscles[m].name);
      EXPECT_EQ(again.muscles[m].inputs.size(), real.muscles[m].inputs.size());
      ASSERT_EQ(again.muscles[m].numbers.size(), real.muscles[m].numbers.size());
      for (const auto& [quantity, number] : real.muscles[m].numbers)
        EXPECT_NEAR(again.muscles[m].numbers.at(quantity).value, number.value, 1e-15 * std::abs(number.value));
    }
    ASSERT_EQ(again.dofs.size(), real.dofs.size());
    for (std::size_t d = 0; d < real.dofs.size(); ++d) EXPECT_EQ(again.dofs[d].muscles, real.dofs[d].muscles);
    ASSERT_EQ(again.curves.size(), real.curves.size());
    for (std::size_t c = 0; c < real.curves.size(); ++c) EXPECT_EQ(again.curves[c].y, real.curves[c].y);
  }
}

// In the file a delay is ten times, a time constant a hundred times its value in seconds.
TEST(OsimxFile, IsReadBackWithTheSameValuesInItsOwnUnits) {
  const test::TemporaryFolder folder;
  const Project project = every_number(Dialect::nmsm);
  write_file(folder / "a.osimx", osimx_text(project));
  const body::OsimXml xml = read_document(folder / "a.osimx");
  const std::vector<ProjectMuscle> read = read_osimx(xml);
  ASSERT_EQ(read.size(), 2U);
  for (const OsimxNumber& number : osimx_numbers()) {
    const double value = project.muscles[1].numbers.at(number.quantity).value;
    EXPECT_NEAR(read[1].numbers.at(number.quantity).value, value, 1e-15 * value) << number.element;
  }
  const pugi::xml_node muscle = body::OsimXml::objects(osimx_model(xml).child("RCNLMuscleSet")).front();
  EXPECT_NEAR(finite_number(xml, muscle, "electromechanical_delay").value(),
              10.0 * project.muscles[0].numbers.at(Quantity::delay).value, 1e-14);
  EXPECT_NEAR(finite_number(xml, muscle, "activation_time_constant").value(),
              100.0 * project.muscles[0].numbers.at(Quantity::activation_time).value, 1e-13);
  EXPECT_EQ(xml.word(osimx_model(xml), "associated_osim_model"), "../models/a & b.osim");
}

}  // namespace
}  // namespace myoid::opensim
