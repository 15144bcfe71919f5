#include "myoid/ground/core/numbers.h"

#include <limits>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(Numbers, InfinityIsAboveEveryNumberAndNanIsNone) {
  EXPECT_GT(kInfinity, std::numeric_limits<double>::max());
  EXPECT_FALSE(kNan == kNan);
}

}  // namespace
}  // namespace myoid::inline ground
