#include "myoid/recording/tables/csv_reader.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

TEST(CsvSeries, UnderstandsUnitsInTheHeader) {
  const CsvSeries s = parse_csv_series("Time (ms),biceps [mV],angle [deg]\n0,1,90\n10,2,180\n", "e.csv");
  EXPECT_DOUBLE_EQ(s.data.time_s()[1], 0.01);
  EXPECT_DOUBLE_EQ(s.data.column("biceps")[1], 2e-3);
  EXPECT_EQ(s.data.channels()[1].unit, Unit::radian);
}

TEST(CsvSeries, ReadsSemicolonsWithCommaDecimals) {
  const CsvSeries s = parse_csv_series("t;a\n0;1,5\n0,5;\n", "e.csv");
  EXPECT_EQ(s.data.time_s()[1], 0.5);
  EXPECT_EQ(s.data.values()(0, 0), 1.5);
  EXPECT_TRUE(std::isnan(s.data.values()(1, 0)));
  EXPECT_EQ(s.repairs.size(), 2U);
}

TEST(CsvSeries, WithoutATimeColumnItSaysWhichColumnsThereAre) {
  try {
    (void)parse_csv_series("a,b\n1,2\n", "e.csv");
    FAIL();
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("a, b"), std::string::npos);
  }
}

TEST(CsvTable, KeepsQuotedSeparators) {
  const CsvTable t = parse_csv_table("a,b\n\"x, y\",\"say \"\"hi\"\"\"\n", "e.csv");
  EXPECT_EQ(t.rows[0], (std::vector<std::string>{"x, y", "say \"hi\""}));
}

TEST(CsvTable, ARowOfAnotherWidthIsRefusedWithItsLine) {
  try {
    (void)parse_csv_table("a,b\n1,2\n3\n", "e.csv");
    FAIL();
  } catch (const ReadError& error) {
    EXPECT_EQ(error.line(), 3U);
    EXPECT_EQ(std::string(error.what()).find("decimal commas"), std::string::npos);
  }
  try {
    (void)parse_csv_table("a,b\n0,5,0,1\n", "e.csv");
    FAIL();
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("decimal commas"), std::string::npos);
  }
}

TEST(ParseCsvSeries, MinutesAreAUnitOfAClockAlone) {
  const CsvSeries s = parse_csv_series("Time [min],F (min)\n0,1\n0.01,2\n", "a.csv");
  EXPECT_NEAR(s.data.time_s()[1], 0.6, 1e-12);
  EXPECT_EQ(s.data.values()(1, 0), 2.0);
}

TEST(ParseCsvSeries, ANumberThatStandsForAMissingValueIsAGapInItsUnit) {
  const CsvSeries s = parse_csv_series("time,q [deg],F [N]\n0,10,5\n1,-9999,4\n2,30,3\n", "a.csv");
  EXPECT_TRUE(std::isnan(s.data.values()(1, 0)));
  EXPECT_EQ(s.data.channels()[0].missing, -9999.0);
  EXPECT_EQ(s.data.channels()[1].missing, std::nullopt);
}

}  // namespace
}  // namespace myoid::recording
