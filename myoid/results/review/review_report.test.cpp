#include "myoid/results/review/review_report.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace myoid::results {
namespace {

const page::Table& table(const page::Report& report, const std::string& id) {
  for (const page::Section& section : report.sections)
    for (const page::Table& each : section.tables)
      if (each.id == id) return each;
  throw std::out_of_range(id);
}

SecondOpinion opinion() {
  SecondOpinion o{.joints = {"knee_angle_r"}, .unknowns = 10, .on_bound = 7};
  ReviewedTorque torque{.trial = "walk", .joint = "knee_angle_r", .is_calibrating = true};
  torque.time_s = Eigen::VectorXd::LinSpaced(50, 100.0, 149.0);
  torque.measured_nm = torque.time_s.array().sin();
  torque.theirs_nm = Eigen::VectorXd::Constant(50, torque.measured_nm.mean());
  torque.theirs = fit::score(torque.measured_nm, torque.theirs_nm);
  o.torques.push_back(torque);
  torque.trial = "run";
  torque.is_calibrating = false;
  torque.theirs.reset();
  torque.ours_time_s = torque.time_s;
  torque.ours_nm = 0.9 * torque.measured_nm;
  torque.ours = fit::score(torque.measured_nm, torque.ours_nm);
  o.torques.push_back(torque);
  ReviewedNumber number{.muscle = "soleus_r", .theirs = 0.05, .on_bound = 1, .standing = Standing::differs};
  number.ours.parameter = "optimal_fiber_length";
  number.ours.unit = Unit::meter;
  number.ours.estimate = 0.04;
  number.ours.ci_low = 0.038;
  number.ours.ci_high = 0.042;
  o.numbers.push_back(number);
  o.strengths.push_back(
      {.joint = "knee_angle_r", .all_nm = 200.0, .without_emg_nm = 150.0, .without_emg = {"vas_int_r"}});
  o.strengths.push_back({.joint = "knee_angle_r", .is_positive = false, .all_nm = 100.0});
  return o;
}

TEST(ReviewReport, MarksWhatPredictsAndWhatDoesNot) {
  const page::Report report = review_report(opinion());
  EXPECT_NO_THROW(page::validate(report));
  const page::Table& torques = table(report, "torques");
  EXPECT_EQ(torques.rows.at(0).at(3).badge, page::Badge::bad);   // the mean: R2 of 0
  EXPECT_EQ(torques.rows.at(0).at(5).badge, page::Badge::none);  // never left out
  EXPECT_EQ(torques.rows.at(1).at(3).badge, page::Badge::none);  // no law
  EXPECT_EQ(torques.rows.at(1).at(5).badge, page::Badge::good);  // 0.99
  const page::Table& strength = table(report, "strength_without_emg");
  EXPECT_EQ(strength.rows.at(0).at(3).text, "75 %");
  EXPECT_EQ(strength.rows.at(0).at(3).badge, page::Badge::bad);
  EXPECT_EQ(strength.rows.at(1).at(3).badge, page::Badge::good);
}

TEST(ReviewReport, ShowsNumbersInTheUnitsOfPeople) {
  const page::Report report = review_report(opinion());
  const std::vector<page::Cell>& row = table(report, "numbers").rows.at(0);
  EXPECT_EQ(row.at(2).text, "cm");
  EXPECT_EQ(row.at(4).text, "5");
  EXPECT_EQ(row.at(7).text, "3.80 to 4.20");
  EXPECT_EQ(row.at(9).badge, page::Badge::bad);
}

TEST(ReviewReport, DrawsLongTrialsFromTheirBeginInSeconds) {
  const page::Report report = review_report(opinion());
  const auto section = std::ranges::find_if(report.sections, [](const page::Section& s) { return !s.figures.empty(); });
  ASSERT_NE(section, report.sections.end());
  const page::Panel& panel = section->figures.at(0).panels.at(0);
  EXPECT_EQ(panel.series.at(0).x.front(), 0.0);
  EXPECT_EQ(panel.x.upper, 30.0);
}

TEST(ReviewReport, HasOneSentenceForEachFinding) {
  EXPECT_EQ(review_sentences(opinion()).size(), 4U);
  SecondOpinion none;
  none.no_law = "NMSM keeps its curves";
  EXPECT_EQ(review_sentences(none).size(), 1U);
}

}  // namespace
}  // namespace myoid::results
