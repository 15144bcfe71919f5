#include "myoid/ground/core/names.h"

#include <array>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

struct Muscle {
  std::string name;
  [[nodiscard]] std::string upper() const { return "BIC"; }
};

TEST(Names, AreJoinedByMemberByFunctionAndAsTheyAre) {
  EXPECT_EQ(name_list(std::vector<Muscle>{{"bic"}, {"tri"}}, &Muscle::name), "bic, tri");
  EXPECT_EQ(name_list(std::vector<Muscle>{{"bic"}, {"tri"}}, &Muscle::upper), "BIC, BIC");
  EXPECT_EQ(name_list(std::array<std::string_view, 3>{"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(name_list(std::vector<std::string>{}), "");
}

}  // namespace
}  // namespace myoid::inline ground
