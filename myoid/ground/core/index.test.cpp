#include "myoid/ground/core/index.h"

#include <type_traits>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(Index, IsTheSameNumberWithoutASign) {
  static_assert(std::is_same_v<decltype(at(3)), std::size_t>);
  EXPECT_EQ(at(0), 0U);
  EXPECT_EQ(at(7), 7U);
  EXPECT_EQ(at(std::ptrdiff_t{1} << 40), std::size_t{1} << 40U);
}

}  // namespace
}  // namespace myoid::inline ground
