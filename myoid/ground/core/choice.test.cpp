#include "myoid/ground/core/choice.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

enum class Side { left, right };
constexpr std::string_view kSides[] = {"left", "right"};
constexpr ChoiceNames choice_names(Side) { return kSides; }

TEST(Choice, EveryEnumeratorIsFoundByItsName) {
  EXPECT_EQ(choice_name(Side::right), "right");
  EXPECT_EQ(choice_named<Side>("left"), Side::left);
  EXPECT_EQ(choice_named<Side>("Left"), std::nullopt);
}

}  // namespace
}  // namespace myoid::inline ground
