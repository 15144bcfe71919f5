#include "myoid/ground/core/units.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(ParseUnit, KnowsTheWordsOfLaboratoryFiles) {
  EXPECT_EQ(parse_unit("mm"), (ScaledUnit{Unit::meter, 1e-3}));
  EXPECT_EQ(parse_unit(" Nmm "), (ScaledUnit{Unit::newton_meter, 1e-3}));
  // A kilogram-force is the weight of 1 kg under standard gravity.
  EXPECT_EQ(parse_unit("kgf"), (ScaledUnit{Unit::newton, 9.80665}));
  EXPECT_EQ(parse_unit("µV"), (ScaledUnit{Unit::volt, 1e-6}));
  EXPECT_EQ(parse_unit("Degrees"), (ScaledUnit{Unit::radian, kDegree}));
}

TEST(ParseUnit, DoesNotConfuseMillivoltsWithMegavolts) {
  EXPECT_EQ(parse_unit("mV"), (ScaledUnit{Unit::volt, 1e-3}));
  EXPECT_FALSE(parse_unit("MV").has_value());
}

TEST(ParseUnit, RefusesWhatItDoesNotKnow) { EXPECT_FALSE(parse_unit("furlong").has_value()); }

}  // namespace
}  // namespace myoid::inline ground
