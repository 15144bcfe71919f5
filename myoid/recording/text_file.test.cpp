#include "myoid/recording/text_file.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::recording {
namespace {

TEST(SplitLines, TreatsAllThreeKindsOfLineEndsAlike) {
  const std::vector<std::string_view> expected{"a", "b", "", "c"};
  EXPECT_EQ(split_lines("a\nb\n\nc\n"), expected);
  EXPECT_EQ(split_lines("a\r\nb\r\n\r\nc"), expected);
  EXPECT_EQ(split_lines("\xEF\xBB\xBF"
                        "a\rb\r\rc"),
            expected);
}

TEST(ParseNumber, TakesTheFormsThatOccurAndNothingElse) {
  EXPECT_EQ(parse_number(" +1.5e-3 "), 1.5e-3);
  EXPECT_TRUE(std::isnan(*parse_number("NaN")));
  EXPECT_TRUE(std::isinf(*parse_number("-Infinity")));
  EXPECT_EQ(parse_number("1e-400"), 0.0);
  EXPECT_FALSE(parse_number("1,5").has_value());
  EXPECT_FALSE(parse_number("1.5 m").has_value());
  EXPECT_FALSE(parse_number("").has_value());
}

TEST(FormatNumber, ReadsBackToTheSameDouble) {
  for (const double x : {0.1, 1.0 / 3.0, -2.5e-17, 1e300})
    EXPECT_EQ(parse_number(format_number(x)), x);
}

TEST(ReadTextFile, SaysWhatIsWrongWithAPath) {
  EXPECT_THROW((void)read_text_file("/nowhere/at/all.trc"), ReadError);
  EXPECT_THROW((void)read_text_file(std::filesystem::temp_directory_path()), ReadError);
}

TEST(EndsWithLine, TellsATextThatStopsInsideALine) {
  EXPECT_TRUE(ends_with_line("1 2\n"));
  EXPECT_TRUE(ends_with_line("1 2\r"));
  EXPECT_FALSE(ends_with_line("1 2"));
}

TEST(LooksCut, ComparesTheDecimalsOfTheLastNumbers) {
  EXPECT_TRUE(looks_cut("0.2\t1.2", "0.1\t1.25"));
  EXPECT_TRUE(looks_cut("0.2\t1", "0.1\t1.25"));
  EXPECT_TRUE(looks_cut("0.2\t1.", "0.1\t1,5 \t"));
  EXPECT_FALSE(looks_cut("0.2\t1.25", "0.1\t1.25"));
  EXPECT_FALSE(looks_cut("0.2\t12", "0.1\t15"));
  EXPECT_FALSE(looks_cut("", ""));
}

}  // namespace
}  // namespace myoid::recording
