#include "myoid/ground/files/byte_source.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground {
namespace {

bool is_refused(const std::string& bytes) {
  ByteSource source(std::as_bytes(std::span(bytes.data(), bytes.size())), "f.c3d");
  try {
    refuse_text_transfer(source, "f.c3d");
  } catch (const ReadError&) {
    return true;
  }
  return false;
}

std::string replaced(const std::string& bytes, bool (*odd)(char), const std::string& by) {
  std::string text;
  for (const char c : bytes) text += odd(c) ? by : std::string(1, c);
  return text;
}

TEST(TextTransfer, BinaryFilesThatWentThroughOneAreRefused) {
  std::mt19937_64 random(7);
  std::string bytes;
  for (int i = 0; i < 20000; ++i) bytes += static_cast<char>(random());
  EXPECT_FALSE(is_refused(bytes));
  EXPECT_TRUE(is_refused(replaced(
      bytes, [](char c) { return c == '\n'; }, "\r\n")));
  EXPECT_TRUE(is_refused(replaced(
      bytes, [](char c) { return (static_cast<unsigned char>(c) & 0x80U) != 0; }, "\xEF\xBF\xBD")));
}

TEST(TextTransfer, SomeLinesOfTextInABinaryFileAreNone) {
  std::string bytes(4096, '\0');
  for (int i = 0; i < 15; ++i) bytes += "a comment\r\n";
  EXPECT_FALSE(is_refused(bytes));
  for (int i = 0; i < 100; ++i) bytes += "a comment\r\n";
  EXPECT_FALSE(is_refused(bytes + "\n"));  // one line feed by itself
}

TEST(TextTransfer, MarksAreCountedAcrossTheParts) {
  std::string bytes(1U << 18U, 'x');
  bytes.back() = '\r';
  bytes += "\nx\n";
  ByteSource source(std::as_bytes(std::span(bytes.data(), bytes.size())), "f");
  const TextMarks marks = text_marks(source, bytes.size());
  EXPECT_EQ(marks.line_feeds, 2U);
  EXPECT_EQ(marks.returned, 1U);
}

}  // namespace
}  // namespace myoid::inline ground
