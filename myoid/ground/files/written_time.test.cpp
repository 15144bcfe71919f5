#include "myoid/ground/files/written_time.h"

#include <utility>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(WrittenTime, ATimeOfTheDayIsReadInEveryUsualForm) {
  for (const auto& [cell, seconds] :
       {std::pair("10:02:03.5", 36123.5), std::pair("10:02:03:250", 36123.25), std::pair("02:03.5", 123.5),
        std::pair("10:02:03.5 pm", 79323.5), std::pair("12:00:01 AM", 1.0), std::pair("01.05.2026 10:02:03,5", 36123.5),
        std::pair("5/1/2026 10:02:03.5 AM", 36123.5), std::pair("1970-01-01 10:02:03", 36123.0)}) {
    const auto time = written_time_s(cell);
    ASSERT_TRUE(time) << cell;
    EXPECT_DOUBLE_EQ(*time, seconds) << cell;
  }
  for (const char* other : {"10:02", "10:02:03:25", "1.5.26", "99:72.5", "13:00:00 PM"})
    EXPECT_FALSE(written_time_s(other)) << other;
}

TEST(WrittenTime, ADateBeforeItCountsAndWhatIsNoTimeIsNone) {
  EXPECT_DOUBLE_EQ(*written_time_s("1970-01-02 00:00:01.25+01:00"), 86401.25);
  for (const char* other : {"10:02", "10.02.03", "2026-13-01 10:02:03", "a:b:c", "10:72:03"})
    EXPECT_FALSE(written_time_s(other)) << other;
}

}  // namespace
}  // namespace myoid::inline ground
