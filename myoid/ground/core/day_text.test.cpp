#include "myoid/ground/core/day_text.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(DayText, IsYearMonthDayOfACalendarsDay) {
  using namespace std::chrono;
  EXPECT_EQ(day_text(year(2026) / 3 / 1), "2026-03-01");
  EXPECT_EQ(day_text(year_month_day(sys_days(days(0)))), "1970-01-01");
  EXPECT_EQ(day_text(year(2025) / 2 / 29), "");
}

}  // namespace
}  // namespace myoid::inline ground
