#include "myoid/results/cohort/group_changes.h"

#include <gtest/gtest.h>

namespace myoid::results {
namespace {

using fit::Method;

ComparedParameter compared(fit::Method method, double difference, Change change) {
  ComparedParameter p;
  p.muscle = "BIC";
  p.first.method = p.second.method = method;
  p.first.parameter = p.second.parameter = "max_isometric_force";
  p.difference = difference;
  if (change != Change::cannot_tell) p.smallest_detectable = 50.0;
  p.change = change;
  return p;
}

PersonChange person(const std::string& name, std::vector<ComparedParameter> parameters) {
  PersonChange made{.person = name, .page = "", .comparison = {}};
  made.comparison.parameters = std::move(parameters);
  return made;
}

TEST(ChangeSection, CountsOnlyPersonsWhoseTwoRecordingsTellTheNumber) {
  const page::Section section = change_section(
      {person("A", {compared(Method::paper, 900.0, Change::differs), compared(Method::torque, 80.0, Change::differs)}),
       person("B", {compared(Method::torque, 10.0, Change::no_change)}),
       person("C", {compared(Method::torque, 700.0, Change::cannot_tell)}), person("D", {})});
  ASSERT_EQ(section.grids.size(), 1U);
  ASSERT_EQ(section.grids[0].rows.size(), 4U);
  EXPECT_EQ(section.grids[0].rows[0].cells[0].value, 80.0);
  EXPECT_EQ(section.grids[0].rows[0].cells[0].lower, 30.0);
  EXPECT_FALSE(section.grids[0].rows[2].cells[0].lower);
  EXPECT_FALSE(section.grids[0].rows[3].cells[0].value);
  const std::vector<page::Cell>& row = section.tables.at(0).rows.at(0);
  EXPECT_EQ(row[3].text, "2");
  EXPECT_EQ(row[4].text, "1");
  EXPECT_EQ(row[5].text, "45");
  EXPECT_EQ(row[7].text, "-");  // a standard deviation of two is no number
}

TEST(ChangeSection, TwoTreatmentsOfOneRecordingAreNoChange) {
  PersonChange treated = person("A", {compared(Method::torque, 80.0, Change::treatment)});
  treated.comparison.one_recording = "Both runs rest on the same recording";
  const page::Section section = change_section({treated});
  EXPECT_TRUE(section.grids.empty());
  EXPECT_TRUE(section.tables.empty());
  EXPECT_EQ(section.paragraphs.size(), 1U);
}

TEST(ChangeSection, AnglesAreInDegrees) {
  ComparedParameter angle = compared(Method::torque, 0.5235987755982988, Change::differs);  // pi / 6
  angle.first.unit = angle.second.unit = Unit::radian;
  angle.smallest_detectable = 0.17453292519943295;
  const page::Section section = change_section({person("A", {angle})});
  const page::StripGrid& grid = section.grids.at(0);
  EXPECT_EQ(grid.columns[0].unit, "°");
  EXPECT_NEAR(grid.rows[0].cells[0].value.value_or(0.0), 30.0, 1e-12);
  EXPECT_NEAR(grid.rows[0].cells[0].lower.value_or(0.0), 20.0, 1e-12);
}

TEST(ChangeSection, NamesPersonsWhoseSessionsAreNotOfOneKind) {
  PersonChange unlike = person("A", {compared(Method::torque, 1.0, Change::no_change)});
  unlike.comparison.unlike = {"the model", "the estimator"};
  const page::Section section = change_section({unlike});
  ASSERT_EQ(section.paragraphs.size(), 1U);
  EXPECT_EQ(section.paragraphs[0], "A: the sessions are not of one kind: the model; the estimator.");
}

}  // namespace
}  // namespace myoid::results
