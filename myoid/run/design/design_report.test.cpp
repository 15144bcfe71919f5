#include "myoid/run/design/design_report.h"

#include <gtest/gtest.h>

namespace myoid::run {
namespace {

fit::ParameterEstimate estimate(double value, double half, fit::Verdict verdict) {
  fit::ParameterEstimate e;
  e.muscle = "BIC";
  e.parameter = "max_isometric_force";
  e.estimate = value;
  e.ci_low = value - half;
  e.ci_high = value + half;
  e.verdict = verdict;
  return e;
}

TEST(NextRecording, EveryMovementHasTheIntervalThatFollowsIt) {
  DesignStudyResult design;
  design.catalogue_size = 150;
  design.beforehand = {estimate(500.0, 250.0, fit::Verdict::weak)};
  PlannedMovement first;
  first.movement.duration_s = 11.0;
  first.rest_before_s = 30.0;
  first.expected = {estimate(500.0, 50.0, fit::Verdict::identified)};
  PlannedMovement second = first;
  second.expected = {estimate(500.0, 25.0, fit::Verdict::identified)};
  design.plan = {first, second};
  const page::Section section = next_recording_section(design);
  ASSERT_EQ(section.tables.size(), 2U);
  const auto& plan = section.tables[0].rows;
  ASSERT_EQ(plan.size(), 3U);
  EXPECT_EQ(plan[0][4].text, "+- 50 %");
  EXPECT_EQ(plan[0][5].text, "0 of 1");
  EXPECT_EQ(plan[1][3].text, "30 s");
  EXPECT_EQ(plan[1][4].text, "+- 10 %");
  EXPECT_EQ(plan[1][5].text, "1 of 1");
  const page::Table& targets = section.tables[1];
  EXPECT_EQ(targets.columns,
            (std::vector<std::string>{"muscle", "parameter", "now", "after 1", "then", "verdict then"}));
  EXPECT_EQ(targets.rows[0][2].text, "+- 50 %");
  EXPECT_EQ(targets.rows[0][3].text, "+- 10 %");
  EXPECT_EQ(targets.rows[0][4].text, "+- 5 %");
}

TEST(NextRecording, WithoutAPossibleMovementItSaysWhatToDo) {
  DesignStudyResult design;
  design.catalogue_size = design.too_hard = 150;
  const page::Section section = next_recording_section(design);
  EXPECT_TRUE(section.tables.empty());
  ASSERT_EQ(section.paragraphs.size(), 1U);
  EXPECT_NE(section.paragraphs[0].find("MVC"), std::string::npos);
}

}  // namespace
}  // namespace myoid::run
