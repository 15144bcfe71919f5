#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::test {

/// Reads codes as page/packing.h describes them.
inline std::vector<int> read_codes(const std::string& text, std::size_t columns = 1) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::size_t at = 0;
  const auto number = [&](int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i, ++at) value = 2 * value + ((kDigits.find(text[at / 6]) >> (5 - at % 6)) & 1U);
    return value;
  };
  std::vector<int> codes(number(32), 0);
  for (std::size_t c = 0; c < columns; ++c) {
    const std::uint32_t order = number(2), k = number(4);
    std::int64_t last = 0, before = 0;
    for (std::size_t i = c; order < 3 && i < codes.size(); i += columns) {
      std::uint32_t ones = 0;
      while (ones < 24 && number(1) == 1) ++ones;
      const std::int64_t folded = ones == 24 ? number(16) : (ones << k) + number(static_cast<int>(k));
      const std::int64_t difference = folded % 2 == 1 ? -(folded + 1) / 2 : folded / 2;
      const std::int64_t expected = order == 0 ? 0 : order == 1 || i == c ? last : 2 * last - before;
      before = i == c ? (difference + expected) & 65535 : last;
      last = (difference + expected) & 65535;
      codes[i] = static_cast<int>(last);
    }
  }
  return codes;
}

}  // namespace myoid::test
