#include "myoid/page/plain_unit.h"

#include <gtest/gtest.h>

namespace myoid::page {
namespace {

TEST(PlainUnit, IsThatOfASentence) {
  EXPECT_EQ(plain_unit(Unit::meter).symbol, "cm");
  EXPECT_DOUBLE_EQ(0.137 * plain_unit(Unit::meter).per_si, 13.7);
  EXPECT_DOUBLE_EQ(kPi * plain_unit(Unit::radian).per_si, 180.0);
  EXPECT_DOUBLE_EQ(0.067 * plain_unit(Unit::second).per_si, 67.0);
  EXPECT_EQ(plain_unit(Unit::newton).symbol, "N");
  EXPECT_DOUBLE_EQ(plain_unit(Unit::newton).per_si, 1.0);
}

}  // namespace
}  // namespace myoid::page
