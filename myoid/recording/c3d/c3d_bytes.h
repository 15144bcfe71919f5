#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::recording {

/// Bytes per block; header, parameters and data each begin with a block.
inline constexpr std::size_t kC3dBlock = 512;

/// Reads and writes the numbers of a C3D file in the byte order and the kind of real of its processor.
///
/// A DEC (VAX F) real has the sign, 8 bits of exponent with bias 128 and the fraction 0.1f, with its two 16-bit words
/// swapped. Once they are swapped back, the same bits as IEEE mean a quarter of IEEE's value. Exponent 0 is zero. Every
/// IEEE number below 2^127 can be written; numbers below 2^-126 become 0.
struct C3dBytes {
  C3dProcessor processor = C3dProcessor::intel;

  [[nodiscard]] std::uint16_t u16(const std::byte* p) const {
    const auto a = static_cast<std::uint16_t>(p[0]);
    const auto b = static_cast<std::uint16_t>(p[1]);
    return processor == C3dProcessor::sgi ? static_cast<std::uint16_t>((a << 8U) | b)
                                          : static_cast<std::uint16_t>((b << 8U) | a);
  }

  [[nodiscard]] std::int16_t i16(const std::byte* p) const { return static_cast<std::int16_t>(u16(p)); }

  [[nodiscard]] float real(const std::byte* p) const {
    std::uint32_t bits = 0;
    std::memcpy(&bits, p, sizeof bits);  // little-endian machine
    if (processor == C3dProcessor::sgi) bits = __builtin_bswap32(bits);
    if (processor == C3dProcessor::dec) return from_dec((bits << 16U) | (bits >> 16U));
    return std::bit_cast<float>(bits);
  }

  void put_u16(std::byte* p, std::uint16_t value) const {
    const auto low = static_cast<std::byte>(value & 0xFFU);
    const auto high = static_cast<std::byte>(value >> 8U);
    p[0] = processor == C3dProcessor::sgi ? high : low;
    p[1] = processor == C3dProcessor::sgi ? low : high;
  }

  /// Returns false if this kind of real cannot hold the value (DEC: NaN, infinity, 2^127 and above).
  [[nodiscard]] bool put_real(std::byte* p, float value) const {
    auto bits = std::bit_cast<std::uint32_t>(value);
    if (processor == C3dProcessor::dec) {
      const std::uint32_t exponent = (bits >> 23U) & 0xFFU;
      if (exponent >= 254U) return false;
      bits = exponent == 0 ? 0U : bits + (2U << 23U);
      bits = (bits << 16U) | (bits >> 16U);
    }
    if (processor == C3dProcessor::sgi) bits = __builtin_bswap32(bits);
    std::memcpy(p, &bits, sizeof bits);
    return true;
  }

 private:
  [[nodiscard]] static float from_dec(std::uint32_t bits) {
    const std::uint32_t exponent = (bits >> 23U) & 0xFFU;
    if (exponent == 0) return 0.0F;
    if (exponent > 2) return std::bit_cast<float>(bits - (2U << 23U));
    return std::ldexp(std::bit_cast<float>(bits), -2);
  }
};
static_assert(std::endian::native == std::endian::little, "big-endian machines: swap in C3dBytes");

}  // namespace myoid::recording
