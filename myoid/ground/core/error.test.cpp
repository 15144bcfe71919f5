#include "myoid/ground/core/error.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(ReadError, BeginsWithPathAndLineSoThatEditorsCanJump) {
  const ReadError error("dir/a.trc", 17, "expected 3 numbers, found 2");
  EXPECT_STREQ(error.what(), "dir/a.trc:17: expected 3 numbers, found 2");
  EXPECT_EQ(error.line(), 17U);
}

TEST(ReadError, LeavesTheLineOutWhenTheWholeFileIsMeant) {
  EXPECT_STREQ(ReadError("a.trc", 0, "the file is empty").what(), "a.trc: the file is empty");
}

}  // namespace
}  // namespace myoid::inline ground
