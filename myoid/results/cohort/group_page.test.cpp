#include "myoid/results/cohort/group_page.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::results {
namespace {

using testing::HasSubstr;

GroupPerson person(int number, double strength, fit::Verdict verdict = fit::Verdict::identified) {
  return {.name = fmt::format("P{}", number),
          .page = fmt::format("P{}/report.html", number),
          .numbers = {{.parameter = "max_isometric_force",
                       .muscle = "BIC",
                       .unit = "N",
                       .verdict = verdict,
                       .estimate = strength,
                       .low = strength - 10.0,
                       .high = strength + 10.0,
                       .truth = {}}},
          .quality = {{.name = "R2 of the fit", .unit = {}, .value = 0.9, .status = {}}}};
}

TEST(RobustDistance, IsThatOfTheMedianInMedianDeviations) {
  // Median 3; deviations 2 1 0 1 97, their median 1.
  const std::vector<double> distance = robust_distances({1, 2, 3, 4, 100});
  EXPECT_DOUBLE_EQ(distance[4], 97.0 / 1.4826);
  EXPECT_DOUBLE_EQ(distance[0], -2.0 / 1.4826);
  // Iglewicz and Hoaglin's modified z-score: 0.6745 (x - median) / MAD.
  EXPECT_NEAR(distance[4], 0.6745 * 97.0, 0.01);
}

TEST(RobustDistance, IsNoneOfFewOrEqualValues) {
  EXPECT_EQ(robust_distances({1, 2, 3, 400}), std::vector<double>(4, 0.0));
  EXPECT_EQ(robust_distances({5, 5, 5, 5, 9}), std::vector<double>(5, 0.0));
}

TEST(GroupPage, NamesThePersonWhoIsFarFromTheOthers) {
  std::vector<GroupPerson> persons;
  for (int i = 0; i < 6; ++i) persons.push_back(person(i, 600.0 + 10.0 * i));
  persons.push_back(person(6, 1900.0));
  const GroupPage page = group_page(persons);
  ASSERT_EQ(page.outliers.size(), 1U);
  EXPECT_EQ(page.outliers[0].person, "P6");
  EXPECT_THAT(outlier_sentence(page.outliers), HasSubstr("P6, BIC max isometric force"));
  ASSERT_EQ(page.persons.grids.size(), 2U) << "quality and one parameter";
  EXPECT_TRUE(page.persons.grids[1].rows[6].cells[0].outlier);
  EXPECT_FALSE(page.persons.grids[1].rows[5].cells[0].outlier);
  EXPECT_EQ(page.persons.tables.at(0).id, "outliers");
}

TEST(GroupPage, ShowsBothReadingsOfEachPersonAndOfTheGroup) {
  std::vector<GroupPerson> persons{person(0, 600.0, fit::Verdict::reproducible), person(1, 640.0),
                                   person(2, 620.0, fit::Verdict::weak)};
  EXPECT_EQ(group_page(persons).persons.tables.at(0).columns.size(), 7U);
  for (const int i : {0, 1}) {
    GroupNumber& number = persons[static_cast<std::size_t>(i)].numbers[0];
    number.given = 500.0 + 20.0 * i;
    number.given_low = *number.given - 2.0;
    number.given_high = *number.given + 4.0;
  }
  const GroupPage page = group_page(persons);
  const page::StripCell& cell = page.persons.grids[1].rows[1].cells[0];
  EXPECT_EQ(cell.value, 640.0);
  EXPECT_EQ(cell.given_value, 520.0);
  EXPECT_EQ(cell.given_lower, 518.0);
  EXPECT_EQ(cell.given_upper, 524.0);
  const page::Table& summary = page.persons.tables.at(0);
  ASSERT_EQ(summary.columns.size(), 10U);
  EXPECT_EQ(summary.rows[0][3].text, "3 of 3");
  EXPECT_EQ(summary.rows[0][4].text, "620");
  EXPECT_EQ(summary.rows[0][7].text, "510");   // of the two that have the reading
  EXPECT_EQ(summary.rows[0][8].text, "14.1");  // 20 / sqrt(2)
  EXPECT_EQ(summary.rows[0][9].text, "3");
}

TEST(GroupPage, DrawsSomeOfManyPersonsAndCountsAll) {
  std::vector<GroupPerson> persons;
  for (int i = 0; i < 1000; ++i) persons.push_back(person(i, 600.0 + 0.1 * i));
  persons.push_back(person(1000, 1900.0));
  const GroupPage page = group_page(persons);
  const page::StripGrid& grid = page.persons.grids[1];
  ASSERT_EQ(grid.rows.size(), 60U);
  EXPECT_EQ(page.persons.grids[0].rows.size(), 60U);
  EXPECT_EQ(grid.rows[0].person, "P0");
  EXPECT_EQ(grid.rows[59].person, "P1000") << "the person far from the others is drawn";
  EXPECT_DOUBLE_EQ(*grid.columns[0].middle, 650.0) << "the median of all";
  EXPECT_EQ(page.persons.tables.at(1).rows[0][3].text, "1001 of 1001");
}

TEST(GroupPage, ANumberThatIsNotToldIsDrawnAndCountsNowhere) {
  std::vector<GroupPerson> persons;
  for (int i = 0; i < 6; ++i) persons.push_back(person(i, 600.0 + 10.0 * i));
  persons.push_back(person(6, 1900.0, fit::Verdict::prior_dominated));
  const GroupPage page = group_page(persons);
  EXPECT_TRUE(page.outliers.empty());
  EXPECT_EQ(outlier_sentence(page.outliers), "");
  EXPECT_EQ(page.persons.grids[1].rows[6].cells[0].value, 1900.0);
  const page::Table& summary = page.persons.tables.at(0);
  EXPECT_EQ(summary.rows[0][3].text, "6 of 7");
  EXPECT_EQ(summary.rows[0][4].text, "625");   // (600 + ... + 650) / 6
  EXPECT_EQ(summary.rows[0][5].text, "18.7");  // 10 sqrt(3.5)
  EXPECT_EQ(*page.persons.grids[1].columns[0].middle, 625.0);
}

}  // namespace
}  // namespace myoid::results
