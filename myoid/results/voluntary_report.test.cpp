#include "myoid/results/voluntary_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;
using fit::Verdict;
using fit::VoluntaryCurve;
using testing::ElementsAre;
using testing::HasSubstr;

ParameterEstimate row(const std::string& parameter, Unit unit, double low, double value, double high, Verdict verdict) {
  ParameterEstimate e{.muscle = "BIC", .tied_to = {}, .parameter = parameter, .unit = unit};
  e.estimate = value;
  e.ci_low = low;
  e.ci_high = high;
  e.given_estimate = value;
  e.given_ci_low = 0.5 * (low + value);
  e.given_ci_high = 0.5 * (high + value);
  e.verdict = verdict;
  return e;
}

/// A biceps with 41 N m at 85 degrees, and 40 W at 60 degrees a second.
IdentificationResult biceps() {
  IdentificationResult method;
  method.method = fit::Method::torque;
  VoluntaryCurve curve{.owner = "BIC", .joint = "elbow_flexion", .muscles = {"BIC"}};
  curve.angle_rad = Eigen::Vector3d(60.0, 85.0, 110.0) * kDegree;
  curve.length_m = Eigen::Vector3d(0.34, 0.33, 0.32);
  curve.torque_nm = Eigen::Vector3d(35.0, 41.0, 36.0);
  curve.low_nm = 0.95 * curve.torque_nm;
  curve.high_nm = 1.05 * curve.torque_nm;
  curve.given_low_nm = 0.98 * curve.torque_nm;
  curve.given_high_nm = 1.02 * curve.torque_nm;
  method.voluntary = {curve};
  method.estimates = {
      row("voluntary_torque", Unit::newton_meter, 38.0, 41.0, 44.0, Verdict::identified),
      row("voluntary_torque_angle", Unit::radian, 78.0 * kDegree, 85.0 * kDegree, 91.0 * kDegree, Verdict::weak),
      row("voluntary_power_60", Unit::watt, 36.0, 40.0, 44.0, Verdict::identified)};
  return method;
}

/// Returns the row of the first curve in the section's table.
std::vector<std::string> row_of(const IdentificationResult& method) {
  const page::Section section = voluntary_section({}, method);
  std::vector<std::string> texts;
  for (const page::Cell& cell : section.tables.at(0).rows.at(0)) texts.push_back(cell.text);
  return texts;
}

TEST(VoluntaryTable, SaysTorqueAngleAndIntervals) {
  EXPECT_THAT(row_of(biceps()), ElementsAre("Biceps (BIC)", "41.0", "38.0 to 44.0", "identified", "85°", "78 to 91",
                                            "weak", "40.0 at 60°/s", "39.5 to 42.5"));
}

TEST(VoluntaryTable, AnOptimumAtTheEndIsAtOrBeyond) {
  IdentificationResult method = biceps();
  method.voluntary[0].torque_nm = Eigen::Vector3d(35.0, 41.0, 45.0);
  EXPECT_EQ(row_of(method)[4], "85° or beyond");
  EXPECT_EQ(voluntary_lines(method)[0].place, "85° or beyond");
}

TEST(VoluntaryTable, OfAJointNamesItsMusclesFirst) {
  IdentificationResult method = biceps();
  method.voluntary[0].of_joint = true;
  method.voluntary[0].direction = -1;
  method.voluntary[0].muscles = {"BIC", "BRA"};
  EXPECT_EQ(voluntary_lines(method)[0].name, "Biceps + Brachialis together (elbow flexion, negative direction)");
}

TEST(VoluntaryTable, WithoutAnglesHasNone) {
  IdentificationResult method = biceps();
  method.voluntary[0].angle_rad.resize(0);
  method.estimates.erase(method.estimates.begin() + 1);
  EXPECT_EQ(row_of(method)[4], "–");
  EXPECT_EQ(row_of(method)[5], "–");
}

TEST(VoluntaryHeadline, HoldsOnlyTorquesAndAnglesThatTheRecordingTells) {
  IdentificationResult method = biceps();
  EXPECT_EQ(voluntary_headline(method),
            "Greatest voluntary torque (95 % interval, identified): Biceps 41.0 N m (38.0 to 44.0) at 85°. ");
  method.voluntary[0].from_mvc = false;
  method.estimates[1].verdict = Verdict::not_identifiable;
  EXPECT_EQ(voluntary_headline(method),
            "Greatest voluntary torque at the largest recorded EMG (95 % interval, identified): "
            "Biceps 41.0 N m (38.0 to 44.0). ");
  method.estimates[0].verdict = Verdict::not_identifiable;
  EXPECT_EQ(voluntary_headline(method), "");
}

TEST(VoluntaryHeadline, SaysEachVerdictWhereTheyDiffer) {
  IdentificationResult method = biceps();
  IdentificationResult other = biceps();
  method.voluntary.push_back(other.voluntary[0]);
  method.voluntary[1].owner = "TRI";
  for (ParameterEstimate& e : other.estimates) {
    e.muscle = "TRI";
    e.verdict = Verdict::weak;
    method.estimates.push_back(e);
  }
  EXPECT_THAT(voluntary_headline(method), HasSubstr("38.0 to 44.0, identified"));
  EXPECT_THAT(voluntary_headline(method), HasSubstr("38.0 to 44.0, weak"));
}

TEST(VoluntaryCsv, HasARowForEachPlace) {
  EXPECT_THAT(voluntary_csv(biceps()),
              HasSubstr("owner,joint,direction,muscles,angle_rad,length_m,torque_nm,low_nm,high_nm,given_low_nm,"
                        "given_high_nm\nBIC,elbow_flexion,positive,BIC,1.0471975511965976,0.34,35,"));
}

TEST(VoluntarySection, HasTheTableAndTheCurve) {
  run::StudyResult result;
  result.source.truth = {{.muscle = "BIC", .parameter = "voluntary_torque", .value = 42.0}};
  const page::Section section = voluntary_section(result, biceps());
  ASSERT_EQ(section.tables.size(), 1U);
  ASSERT_EQ(section.tables[0].rows.size(), 1U);
  const std::vector<page::Cell>& row = section.tables[0].rows[0];
  ASSERT_EQ(row.size(), section.tables[0].columns.size());
  EXPECT_EQ(row[0].text, "Biceps (BIC)");
  EXPECT_EQ(row[1].text, "41.0");
  EXPECT_THAT(row[7].text, HasSubstr("40.0 at 60°/s"));
  EXPECT_EQ(row[9].badge, page::Badge::good);
  ASSERT_EQ(section.figures.size(), 1U);
  EXPECT_EQ(section.figures[0].panels[0].series[2].y[1], 41.0);
  EXPECT_EQ(section.paragraphs.size(), 1U);
  IdentificationResult without = biceps();
  without.voluntary[0].from_mvc = false;
  EXPECT_THAT(voluntary_section(result, without).paragraphs.back(), HasSubstr("No maximal contraction"));
}

}  // namespace
}  // namespace myoid::results
