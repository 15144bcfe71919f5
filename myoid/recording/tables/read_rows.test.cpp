#include "myoid/recording/tables/read_rows.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/message_of.h"
#include "tests/support/repair_lines.h"

namespace myoid::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Columns t, a and b of a text without a header.
TableRows three_columns(char separator) {
  TableRows rows;
  rows.separator = separator;
  rows.end = 100000;
  rows.names = {"t", "a", "b"};
  rows.clock = {0};
  rows.values = {1, 2};
  return rows;
}

std::string refusal(const std::string& text, const TableRows& rows) {
  return test::message_of<ReadError>([&] { (void)read_rows(TableText(text), rows, "f.csv"); });
}

TEST(ReadRows, EveryNumberStandsInItsColumn) {
  const TableNumbers n = read_rows(TableText("0,1.5,-2\n\"1\", 3 ,4e-3\n2,,n/a\n"), three_columns(','), "f.csv");
  ASSERT_EQ(n.values.rows(), 3);
  EXPECT_EQ(n.clock.col(0), Eigen::Vector3d(0.0, 1.0, 2.0));
  EXPECT_EQ(n.values(0, 1), -2.0);
  EXPECT_EQ(n.values(1, 0), 3.0);
  EXPECT_EQ(n.values(1, 1), 4e-3);
  EXPECT_TRUE(n.values.row(2).array().isNaN().all());
  EXPECT_THAT(n.lines, ElementsAre(1U, 2U, 3U));
}

TEST(ReadRows, ARowThatIsWiderOrNarrowerThanTheHeaderIsAnErrorWithItsLine) {
  const TableRows rows = three_columns(',');
  EXPECT_THAT(refusal("0,1,2\n1,1,2,3\n2,1,2\n", rows), HasSubstr("f.csv:2: 4 cells, expected 3"));
  EXPECT_THAT(refusal("0,1,2\n1,1\n2,1,2\n", rows), HasSubstr("f.csv:2: 2 cells, expected 3"));
  EXPECT_EQ(refusal("0,1,2\n1,1,2,,\n2,1,2\n", rows), "(no error)");  // empty cells too many
  // Decimal commas where commas separate: every row is too wide.
  EXPECT_THAT(refusal("0,0,1,5,2,5\n0,1,1,5,2,5\n", rows), HasSubstr("decimal commas"));
}

TEST(ReadRows, OneDecisionOnDecimalCommasHoldsForAllRows) {
  const TableNumbers n = read_rows(TableText("0;1,5;2\n0,5;2,5;3\n"), three_columns(';'), "f.csv");
  EXPECT_EQ(n.values(1, 0), 2.5);
  EXPECT_THAT(test::repair_lines(n.repairs), HasSubstr("1: comma decimals"));
  EXPECT_THAT(refusal("0;1,5;2\n1;1.234;3\n", three_columns(';')), HasSubstr("f.csv:2: '1.234'"));
  EXPECT_THAT(refusal("0;1.234,5;2\n", three_columns(';')), HasSubstr("1.234,5"));
}

TEST(ReadRows, ABlankLineDoesNotEndTheTable) {
  const TableNumbers n = read_rows(TableText("0,1,2\n\n1,3,4\n,,\n\n"), three_columns(','), "f.csv");
  EXPECT_EQ(n.values.rows(), 2);
  EXPECT_THAT(test::repair_lines(n.repairs), HasSubstr("2: a blank"));
  EXPECT_THAT(refusal("0,1,2\n,,\n1,3,4\n", three_columns(',')), HasSubstr("f.csv:2: "));
}

TEST(ReadRows, ALastRowWithoutALineEndIsKeptIfItIsComplete) {
  TableRows rows = three_columns(',');
  const std::string text = "0,1,2.25\n1,3,4.25\n2,5,6.25";
  EXPECT_EQ(read_rows(TableText(text), rows, "f.csv").values.rows(), 3);
  EXPECT_EQ(read_rows(TableText(text.substr(0, text.size() - 1)), rows, "f.csv").values.rows(), 2);
  EXPECT_EQ(read_rows(TableText("0,1,2.5e-03\n1,3,4.5e-03\n2,5,6.5e-0"), rows, "f.csv").values.rows(), 2);
  EXPECT_EQ(read_rows(TableText("0,1,2.5e-03\n1,3,4.5e-03\n2,5,6.5"), rows, "f.csv").values.rows(), 2);
  // Where the number of decimals varies, fewer decimals are no sign of a cut.
  EXPECT_EQ(read_rows(TableText("0,1,2.5\n1,3,4.25\n2,5,6.5"), rows, "f.csv").values.rows(), 3);
  EXPECT_EQ(read_rows(TableText("0,1,2\n1,3\n"), rows, "f.csv").values.rows(), 1);
  rows.rows_said = 4.0;
  EXPECT_EQ(read_rows(TableText(text), rows, "f.csv").values.rows(), 2);
  rows.rows_said = 3.0;
  EXPECT_EQ(read_rows(TableText(text), rows, "f.csv").values.rows(), 3);
  // Its last number has fewer digits than the one above: the row is cut off, and then a row is missing.
  const TableNumbers cut = read_rows(TableText(text.substr(0, text.size() - 1)), rows, "f.csv");
  EXPECT_EQ(cut.values.rows(), 2);
  EXPECT_THAT(test::repair_lines(cut.repairs), HasSubstr("3 rows"));
  EXPECT_TRUE(cut.repairs.back().lost);
  // A larger loss comes first.
  rows.rows_said = 300.0;
  const std::vector<Repair> repairs = read_rows(TableText("0,1,2\n1,3,4\n2,5\n"), rows, "f.csv").repairs;
  ASSERT_EQ(repairs.size(), 2U);
  EXPECT_EQ(repairs[0].line, 0U);  // of the header
  EXPECT_EQ(repairs[1].line, 3U);
  rows.rows_said = 1.0;
  EXPECT_FALSE(read_rows(TableText("0,1,2\n1,3,4\n"), rows, "f.csv").repairs.back().lost);
}

TEST(ReadRows, ChannelsThatHaveEndedDoNotBeginAgain) {
  TableRows rows = three_columns(',');
  rows.short_row = ShortRow::ended;
  EXPECT_EQ(read_rows(TableText("0,1,2\n1,3\n2,5\n"), rows, "f.csv").values.rows(), 3);
  EXPECT_THAT(refusal("0,1,2\n1,3\n2,5,6\n", rows), HasSubstr("f.csv:2: 2 cells"));
}

TEST(ReadRows, ManyRowsAreReadAsOneByOne) {
  // Rows are read in blocks at the same time; the sum over a column of 0 .. n - 1 is n (n - 1) / 2.
  constexpr int kRows = 5000;
  std::string text;
  for (int i = 0; i < kRows; ++i) text += std::to_string(i) + "," + std::to_string(i) + ",1\n";
  const TableNumbers n = read_rows(TableText(text), three_columns(','), "f.csv");
  EXPECT_EQ(n.values.col(0).sum(), kRows * (kRows - 1) / 2.0);
  EXPECT_EQ(n.values.col(1).sum(), kRows);
}

}  // namespace
}  // namespace myoid::recording
