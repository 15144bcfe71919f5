#include "myoid/ground/files/number_text.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {
namespace {

std::string text_of(NumberText& numbers, double value) {
  char text[NumberText::kRoom];
  return {text, numbers.put(text, value)};
}

TEST(NumberText, OfANumberThatComesAgainIsAsOfOneThatIsNew) {
  NumberText many(1'000'000), few(10);
  const double smallest = std::numeric_limits<double>::denorm_min();
  for (int again = 0; again < 3; ++again) {
    for (const double value : {0.0, -0.0, 1.0, -1.5, 0.1, 1e22, 1e23, 5e-324, smallest, -1e-300,
                               std::numeric_limits<double>::max(), -1.2345678901234567e-308}) {
      EXPECT_EQ(text_of(many, value), format_number(value));
      EXPECT_EQ(text_of(few, value), format_number(value));
      EXPECT_EQ(text_of(many, value).starts_with("-"), std::signbit(value));
    }
  }
}

TEST(NumberText, ReadsBackWhetherNumbersRepeatOrNot) {
  // Counts of a converter, then numbers that never repeat, then counts again: the look-up pauses and resumes.
  std::mt19937_64 engine(7);
  NumberText numbers(1'000'000);
  for (int i = 0; i < 60'000; ++i) {
    const bool repeats = i < 20'000 || i > 40'000;
    const auto drawn = static_cast<double>(engine() >> 11);
    const double value = repeats ? std::fmod(drawn, 4096.0) * 3.0517578125e-7 - 1e-3 : drawn * 1e-17;
    ASSERT_EQ(*parse_number(text_of(numbers, value)), value);
  }
}

}  // namespace
}  // namespace myoid::inline ground
