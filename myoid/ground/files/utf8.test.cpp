#include "myoid/ground/files/utf8.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(Utf8, CharactersAreThoseOfTheStandard) {
  const std::string_view text = "a\u00e4\u20ac\U0001F600";
  std::size_t i = 0;
  for (const char32_t expected : {U'a', U'\u00e4', U'\u20ac', U'\U0001F600'}) {
    const CodePoint point = code_point_at(text, i);
    EXPECT_TRUE(point.valid);
    EXPECT_EQ(point.value, expected);
    i += point.bytes;
  }
  EXPECT_EQ(i, text.size());
}

TEST(Utf8, OverlongSurrogateCutAndStrayBytesAreNone) {
  for (const std::string_view text :
       {"\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8", "\x80", "\xE2\x82", "\xC3(", "\xFF"})
    EXPECT_FALSE(is_utf8(text));
  EXPECT_TRUE(is_utf8("\xF4\x8F\xBF\xBF"));
  EXPECT_TRUE(is_utf8(""));
}

TEST(Utf8, WhatSteersATerminalOrTurnsWritingIsControl) {
  for (const char32_t c : {0x00U, 0x1BU, 0x7FU, 0x9BU, 0x2028U, 0x202EU, 0x2066U})
    EXPECT_TRUE(is_control(c)) << static_cast<unsigned>(c);
  for (const char32_t c : {0x20U, 0xA0U, 0x200DU, 0x5D0U, 0xFEFFU, 0x1F600U})
    EXPECT_FALSE(is_control(c)) << static_cast<unsigned>(c);
}

}  // namespace
}  // namespace myoid::inline ground
