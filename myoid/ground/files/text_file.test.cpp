#include "myoid/ground/files/text_file.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"

namespace myoid::inline ground {
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
  for (const double x : {0.1, 1.0 / 3.0, -2.5e-17, 1e300}) EXPECT_EQ(parse_number(format_number(x)), x);
}

// The C library rounds correctly too: both texts agree for every number, halves included.
TEST(AppendFixed, WritesWhatTheCLibraryWrites) {
  math::Random random(3);
  std::vector<double> values{0.0, -0.0, 0.5, 1.5, 2.5, 0.125, -0.375, 1e-300, 999.999999995, 1e14, 3e15, -1e22, 1e300};
  for (int i = 0; i < 20000; ++i) {
    const double size = std::pow(10.0, 24.0 * random.uniform() - 12.0);
    values.push_back((2.0 * random.uniform() - 1.0) * size);
    values.push_back(std::round(values.back() * 1e4) / 1e4 + 5e-9);  // close to a half
  }
  for (const int decimals : {0, 1, 3, 8, 9, 12}) {
    for (const double value : values) {
      char expected[400];
      const int count = std::snprintf(expected, sizeof expected, "%16.*f", decimals, value);
      char text[kFixedRoom];
      const char* const end = write_fixed(text, value, decimals, 16);
      ASSERT_EQ(std::string_view(text, static_cast<std::size_t>(end - text)),
                std::string_view(expected, static_cast<std::size_t>(count)));
    }
  }
  char text[kFixedRoom];
  EXPECT_EQ(std::string(text, write_fixed(text, std::nan(""), 8, 5)), "  NaN");
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

TEST(LooksCut, ComparesExponentsToo) {
  EXPECT_TRUE(looks_cut("0.2\t1.25e-0", "0.1\t1.25e-03"));
  EXPECT_TRUE(looks_cut("0.2\t1.25", "0.1\t1.25e-03"));
  EXPECT_FALSE(looks_cut("0.2\t1.2e-03", "0.1\t1.25e-03"));
}

TEST(TextFile, ADeviceThatNeverEndsIsRefused) { EXPECT_THROW((void)read_text_file("/dev/zero"), ReadError); }

}  // namespace
}  // namespace myoid::inline ground
