#include "myoid/ground/math/butterworth.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

constexpr double kRoundOff = 1e-12;

TEST(Butterworth, SecondOrderLowPassHasTheClosedFormCoefficients) {
  // f_c = f_s/4: w = 1, so a0 = 2 + sqrt(2), b0 = 1/a0, a1 = 0, a2 = (2 - sqrt 2)/a0.
  const auto sections = design_butterworth(FilterBand::low_pass, 2, 25.0, 100.0);
  ASSERT_EQ(sections.size(), 1U);
  const double a0 = 2.0 + std::sqrt(2.0);
  EXPECT_NEAR(sections[0].b0, 1.0 / a0, kRoundOff);
  EXPECT_NEAR(sections[0].a1, 0.0, kRoundOff);
  EXPECT_NEAR(sections[0].a2, (2.0 - std::sqrt(2.0)) / a0, kRoundOff);
}

TEST(Butterworth, OnePassHasGainOneOverRootTwoAtTheCutOffInEveryOrderAndBand) {
  for (const FilterBand band : {FilterBand::low_pass, FilterBand::high_pass}) {
    for (const int order : {1, 2, 3, 4, 5, 8}) {
      const auto sections = design_butterworth(band, order, 6.0, 100.0);
      EXPECT_NEAR(gain(sections, 6.0, 100.0), std::sqrt(0.5), kRoundOff) << "order " << order;
    }
  }
}

TEST(Butterworth, FollowsTheAnalogPrototypeAtPreWarpedFrequencies) {
  const auto sections = design_butterworth(FilterBand::low_pass, 4, 20.0, 1000.0);
  const double ratio = std::tan(M_PI * 35.0 / 1000.0) / std::tan(M_PI * 20.0 / 1000.0);
  EXPECT_NEAR(gain(sections, 35.0, 1000.0), 1.0 / std::sqrt(1.0 + std::pow(ratio, 8)), 1e-10);
}

TEST(Butterworth, PassesAConstantOrStopsIt) {
  EXPECT_NEAR(gain(design_butterworth(FilterBand::low_pass, 3, 6.0, 100.0), 0.0, 100.0), 1.0, kRoundOff);
  EXPECT_NEAR(gain(design_butterworth(FilterBand::high_pass, 3, 6.0, 100.0), 0.0, 100.0), 0.0, kRoundOff);
}

TEST(TwoPassCutOff, MakesTheTwoPassesTogetherMinusThreeDecibel) {
  for (const FilterBand band : {FilterBand::low_pass, FilterBand::high_pass}) {
    for (const int order : {1, 2, 4}) {
      const double design = two_pass_cutoff_hz(band, order, 6.0, 30.0);
      const double one_pass = gain(design_butterworth(band, order, design, 30.0), 6.0, 30.0);
      EXPECT_NEAR(one_pass * one_pass, std::sqrt(0.5), kRoundOff);
    }
  }
}

TEST(TwoPassCutOff, IsCorrectedInThePreWarpedDomain) {
  // The naive correction gives 6 / 0.8022 = 7.48 Hz; at 30 Hz the right design is 7.03 Hz.
  EXPECT_NEAR(two_pass_cutoff_hz(FilterBand::low_pass, 2, 6.0, 30.0), 7.03, 0.005);
}

TEST(Butterworth, RefusesACutOffAboveHalfTheRate) {
  EXPECT_THROW((void)design_butterworth(FilterBand::low_pass, 2, 60.0, 100.0), InvalidInput);
  EXPECT_THROW((void)design_butterworth(FilterBand::low_pass, 2, 0.0, 100.0), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
