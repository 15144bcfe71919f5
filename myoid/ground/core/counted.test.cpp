#include "myoid/ground/core/counted.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(Counted, OneIsSingularAndAllOthersArePlural) {
  EXPECT_EQ(counted(0, "file"), "0 files");
  EXPECT_EQ(counted(1, "file"), "1 file");
  EXPECT_EQ(counted(2, "file"), "2 files");
}

}  // namespace
}  // namespace myoid::inline ground
