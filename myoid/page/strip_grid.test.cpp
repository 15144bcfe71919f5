#include "myoid/page/strip_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::page {
namespace {

using testing::HasSubstr;
using testing::Not;

StripCell number(double value, double half, Badge badge, std::string verdict) {
  StripCell cell;
  cell.value = value;
  cell.lower = value - half;
  cell.upper = value + half;
  cell.badge = badge;
  cell.verdict = std::move(verdict);
  return cell;
}

/// Three persons' F_max of one muscle; the third one's is not told, the fourth has none.
StripGrid four() {
  StripGrid grid;
  grid.id = "f";
  grid.title = "max isometric force";
  grid.columns.resize(1);
  grid.columns[0].name = "BIC";
  grid.columns[0].unit = "N";
  grid.rows = {{"A", "A/report.html", {number(100, 10, Badge::good, "identified")}},
               {"B & C", "", {number(200, 500, Badge::weak, "weak")}},
               {"D", "", {number(900, 10, Badge::none, "not_identifiable")}},
               {"E", "", {StripCell{}}}};
  return grid;
}

TEST(StripGrid, TheScaleHoldsTheNumbersThatAreToldAndIntervalsAsFarAsThatRange) {
  const StripScale scale = strip_scale(four(), 0);
  // Values 100 to 200; intervals reach 100 beyond at most; 5 to either side.
  EXPECT_DOUBLE_EQ(scale.lower, 0.0 - 5.0);
  EXPECT_DOUBLE_EQ(scale.upper, 300.0 + 5.0);
}

TEST(StripGrid, TheIntervalOfOnePersonIsOnTheScale) {
  StripGrid grid = four();
  grid.rows.resize(1);
  grid.columns[0] = {.name = "BIC", .unit = "N"};
  grid.rows[0].cells[0] = {.value = 0.0, .lower = -60.0, .upper = 60.0, .badge = Badge::good};
  const StripScale scale = strip_scale(grid, 0);
  EXPECT_LT(scale.lower, -60.0);
  EXPECT_GT(scale.upper, 60.0);
}

TEST(StripGrid, OfNumbersThatNobodyToldTheScaleHoldsAll) {
  StripGrid grid = four();
  for (StripRow& row : grid.rows) row.cells[0].badge = Badge::none;
  EXPECT_GT(strip_scale(grid, 0).upper, 900.0);
  for (StripRow& row : grid.rows) row.cells[0].value.reset();
  EXPECT_LT(strip_scale(grid, 0).lower, strip_scale(grid, 0).upper);
}

TEST(StripGrid, DrawsEachPersonWhereTheNumberIs) {
  StripGrid grid = four();
  grid.rows[0].cells[0].outlier = true;
  const std::string html = strip_grid_html(grid);
  // 100 on the scale from -5 to 305.
  EXPECT_THAT(html, HasSubstr("<svg x=\"33.87%\" y=\"50%\""));
  EXPECT_THAT(html, HasSubstr("<a href=\"A/report.html\">A</a>"));
  EXPECT_THAT(html, HasSubstr("B &amp; C, BIC: 200 N, 95 % interval"));
  EXPECT_THAT(html, HasSubstr("class=\"ring\""));
  EXPECT_THAT(html, HasSubstr("class=\"untold\""));
  EXPECT_THAT(html, HasSubstr("E, BIC: none"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

TEST(StripGrid, TheReadingGivenGeometryAndSensorsIsAThickBarUnderTheSameMark) {
  StripGrid grid = four();
  StripCell& cell = grid.rows[0].cells[0];
  EXPECT_THAT(strip_grid_html(grid), Not(HasSubstr("if geometry and sensors were exact")));
  cell.given_value = 101.0;
  cell.given_lower = 98.0;
  cell.given_upper = 104.0;
  const std::string html = strip_grid_html(grid);
  // The scale goes from -5 to 305: 98 is at 103/310, 104 at 109/310.
  EXPECT_THAT(html, HasSubstr("<line x1=\"33.23%\" x2=\"35.16%\" y1=\"10\" y2=\"10\""));
  EXPECT_THAT(html, HasSubstr("stroke-width=\"6\""));
  EXPECT_THAT(html, HasSubstr("<svg x=\"33.87%\" y=\"50%\""));
  EXPECT_THAT(html, HasSubstr("given geometry and sensors 98"));
  EXPECT_THAT(html, HasSubstr("if geometry and sensors were exact"));
  EXPECT_THAT(strip_grid_csv(grid), HasSubstr("A,BIC,N,100,90,110,101,98,104,,identified,no\n"));
}

TEST(StripGrid, AReproducibleNumberIsDrawnAsOneThatIsTold) {
  StripGrid grid = four();
  grid.rows[2].cells[0].badge = Badge::repeat;
  EXPECT_GT(strip_scale(grid, 0).upper, 900.0);
}

TEST(StripGrid, TheFileHasTheNumbersAsTheyAre) {
  EXPECT_EQ(strip_grid_csv(four()),
            "person,number,unit,value,lower,upper,given_value,given_lower,given_upper,truth,verdict,outlier\n"
            "A,BIC,N,100,90,110,,,,,identified,no\n"
            "B & C,BIC,N,200,-300,700,,,,,weak,no\n"
            "D,BIC,N,900,890,910,,,,,not_identifiable,no\n");
}

TEST(StripGrid, ARowWithoutACellForEachColumnIsRefused) {
  Report report;
  report.sections.emplace_back();
  report.sections[0].id = "s";
  report.sections[0].grids.push_back(four());
  validate(report);
  report.sections[0].grids[0].rows[1].cells.clear();
  EXPECT_THROW(validate(report), InvalidInput);
}

}  // namespace
}  // namespace myoid::page
