#include "myoid/core/numbers.h"

#include <limits>

#include <gtest/gtest.h>

namespace myoid {
namespace {

TEST(Numbers, InfinityIsAboveEveryNumberAndNanIsNone) {
  EXPECT_GT(kInfinity, std::numeric_limits<double>::max());
  EXPECT_FALSE(kNan == kNan);
}

}  // namespace
}  // namespace myoid
