#include "myoid/ground/core/wrapped_text.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(WrappedText, FillsLinesUpToTheWidthWithTheirIndent) {
  EXPECT_EQ(wrapped("one two three", 9, 2), "  one two\n  three\n");
  EXPECT_EQ(wrapped("one two three", 8, 2), "  one\n  two\n  three\n");
  EXPECT_EQ(wrapped("one two three", 9, 1, 2), " one two\n   three\n");
  EXPECT_EQ(wrapped("a longer-than-the-width b", 5), "a\nlonger-than-the-width\nb\n");
}

TEST(WrappedText, KeepsLineEndsAndCountsCodePoints) {
  EXPECT_EQ(wrapped("one\n\ntwo", 20, 1), " one\n\n two\n");
  EXPECT_EQ(columns_of("−dl/dq"), 6U);
  EXPECT_EQ(wrapped("−− −−", 5), "−− −−\n");
}

}  // namespace
}  // namespace myoid::inline ground
