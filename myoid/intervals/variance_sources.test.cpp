#include <set>

#include <gtest/gtest.h>

#include "myoid/intervals/result.h"

namespace myoid::identification {
namespace {

TEST(VarianceSources, EachHasAColumnOfItsOwn) {
  EXPECT_EQ(std::set<std::string_view>(kSourceColumns.begin(), kSourceColumns.end()).size(),
            static_cast<std::size_t>(kSourceCount));
  EXPECT_EQ(kSourceColumns[static_cast<std::size_t>(Source::literature)], "literature");
  EXPECT_EQ(kSourceColumns[static_cast<std::size_t>(Source::torque_scale)], "torque_scale");
  EXPECT_EQ(kSourceColumns[static_cast<std::size_t>(Source::model)], "model");
}

}  // namespace
}  // namespace myoid::identification
