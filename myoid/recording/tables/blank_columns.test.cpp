#include "myoid/recording/tables/blank_columns.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/makers/emg_table.h"

namespace myoid::recording {
namespace {

// Foot times pound-force, both exact.
constexpr double kFootPound = 0.3048 * 0.45359237 * 9.80665;

TEST(BlankColumns, NamesOverNumbersThatBlanksSeparateAreATable) {
  const CsvSeries s = parse_emg_table("time EMG[mV]  F[N]\n0.00   0.5 1.2\n0.01  -0.6 1.3\n0.02 0.7 1.4\n", "a.txt");
  ASSERT_EQ(s.data.channel_count(), 2);
  EXPECT_EQ(s.data.channels()[0], (Channel{"EMG", Unit::volt}));
  EXPECT_EQ(s.data.channels()[1], (Channel{"F", Unit::newton}));
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.02);
  EXPECT_DOUBLE_EQ(s.data.values()(1, 0), -0.6e-3);
  EXPECT_EQ(parse_csv_series("time  knee\n0 1\n1 2\n2 3\n", "a.txt").data.values()(2, 0), 3.0);
  EXPECT_DOUBLE_EQ(parse_csv_series("time  knee\n0,0 1,5\n0,5 2,5\n1,0 3,5\n", "a.txt").data.values()(1, 0), 2.5);
}

TEST(BlankColumns, ADynamometersUnitsStandBelowTheirColumns) {
  // The first column has its unit for a name; one name holds a blank; the row of units has one cell less.
  const CsvSeries s = parse_emg_table(
      "  Biodex System 4\n  Curve Data\n  Date: 2/3/2021\n\n"
      " mSec     TORQUE     POSITION     POS (ANAT)     VELOCITY\n"
      "           FT-LBS     DEGREES      DEGREES        DEG/SEC\n"
      "------------------------------------------------------------\n"
      "     0        0.0       10.0       80.0       60.0\n"
      "    10       -1.5       10.6       79.4       60.0\n"
      "    20      100.0       11.2       78.8      -60.0\n",
      "a.txt");
  ASSERT_EQ(s.data.channel_count(), 4);
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.02);
  EXPECT_EQ(s.data.channels()[0], (Channel{"TORQUE", Unit::newton_meter}));
  EXPECT_EQ(s.data.channels()[2], (Channel{"POS (ANAT)", Unit::radian}));
  EXPECT_EQ(s.data.channels()[3], (Channel{"VELOCITY", Unit::radian_per_second}));
  EXPECT_NEAR(s.data.values()(2, 0), 100.0 * kFootPound, 1e-9);
  EXPECT_NEAR(s.data.values()(1, 2), 79.4 * kDegree, 1e-15);
}

TEST(BlankColumns, ACellThatIsLostIsRefusedWithItsLine) {
  try {
    (void)parse_emg_table("time a b\n0 1 2\n1 2 3\n2 3\n3 4 5\n", "a.txt");
    FAIL();
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("a.txt:4: "), std::string::npos) << error.what();
  }
}

TEST(BlankColumns, OtherTextsStayAsTheyAre) {
  for (const char* text : {"time,a\n0,1\n1,2\n", "time\ta\n0\t1\n1\t2\n", "a b\nno numbers here\n", "time a\n", ""})
    EXPECT_FALSE(tabs_for_blanks(TableText(text))) << text;
}

}  // namespace
}  // namespace myoid::recording
