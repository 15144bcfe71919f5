#include "myoid/ground/core/json_array.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(JsonArray, HoldsTheMembersInOrderAndIsAnArrayWithoutAny) {
  const auto doubled = [](int n) { return 2 * n; };
  EXPECT_EQ(array_of(std::vector<int>{1, 2, 3}, doubled).dump(), "[2,4,6]");
  EXPECT_EQ(array_of(std::vector<int>{}, doubled).dump(), "[]");
}

}  // namespace
}  // namespace myoid::inline ground
