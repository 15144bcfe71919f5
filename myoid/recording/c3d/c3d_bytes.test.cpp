#include "myoid/recording/c3d/c3d_bytes.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace myoid::recording {
namespace {

std::array<std::byte, 4> four(unsigned a, unsigned b, unsigned c, unsigned d) {
  return {std::byte(a), std::byte(b), std::byte(c), std::byte(d)};
}

TEST(C3dBytes, DecRealsAreThoseOfTheVaxArchitectureHandbook) {
  const C3dBytes dec{C3dProcessor::dec};
  // F_floating: 1.0 = 0.5 * 2^1, exponent 129 -> first word 0x4080; the fraction of 3.5 is 0.875.
  EXPECT_EQ(dec.real(four(0x80, 0x40, 0, 0).data()), 1.0F);
  EXPECT_EQ(dec.real(four(0x80, 0xC0, 0, 0).data()), -1.0F);
  EXPECT_EQ(dec.real(four(0x60, 0x41, 0, 0).data()), 3.5F);
  EXPECT_EQ(dec.real(four(0x49, 0x41, 0xD0, 0x0F).data()), 3.14159012F);
  EXPECT_EQ(dec.real(four(0, 0, 0, 0).data()), 0.0F);
  EXPECT_EQ(dec.real(four(0xFF, 0x7F, 0xFF, 0xFF).data()), std::ldexp(16777215.0F, 103));  // largest
}

TEST(C3dBytes, WhatIsWrittenIsReadForEveryProcessor) {
  std::mt19937 random(3);
  for (const auto processor : {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::sgi}) {
    const C3dBytes number{processor};
    std::array<std::byte, 4> bytes{};
    for (int i = 0; i < 10000; ++i) {
      const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
      const bool normal = std::isnormal(value) && std::abs(value) < std::ldexp(1.0F, 127);
      if (!normal) continue;
      ASSERT_TRUE(number.put_real(bytes.data(), value));
      ASSERT_EQ(number.real(bytes.data()), value);
    }
    number.put_u16(bytes.data(), 0x1234);
    EXPECT_EQ(number.u16(bytes.data()), 0x1234);
    EXPECT_EQ(bytes[0], processor == C3dProcessor::sgi ? std::byte{0x12} : std::byte{0x34});
  }
  std::array<std::byte, 4> bytes{};
  EXPECT_FALSE(C3dBytes{C3dProcessor::dec}.put_real(bytes.data(), std::nanf("")));
  EXPECT_FALSE(C3dBytes{C3dProcessor::dec}.put_real(bytes.data(), std::ldexp(1.0F, 127)));
}

}  // namespace
}  // namespace myoid::recording
