#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace myoid::inline ground {

/// Writes the shortest text that reads back to the same double (format_number) to a place with
/// NumberText::kRoom bytes; returns the place behind it.
[[nodiscard]] char* put_number(char* at, double value);

/// Writes the shortest decimal texts that read back to the same double, as format_number does.
/// Numbers of a recording repeat, because an A/D converter has 65,536 values or fewer: the texts of
/// the latest numbers are kept and copied. Not safe for several threads at once.
class NumberText {
 public:
  static constexpr std::size_t kRoom = 32;

  /// Prepares for about `count` numbers: a small count does not justify the memory.
  explicit NumberText(std::size_t count);

  /// Announces a number that is put soon: fetching its text from memory takes longer than copying it.
  void announce(double value) const {
    if (unasked_ == 0 && !kept_.empty()) __builtin_prefetch(&kept_[index_of(std::bit_cast<std::uint64_t>(value))]);
  }

  /// Writes the number at a place with kRoom bytes; returns the place behind it.
  [[nodiscard]] char* put(char* at, double value) {
    if (unasked_ > 0 || kept_.empty()) return put_unasked(at, value);
    if (asked_ == kWindow) judge();
    ++asked_;
    const auto bits = std::bit_cast<std::uint64_t>(value);
    Kept& kept = kept_[index_of(bits)];
    if (kept.bits != bits) return put_and_keep(at, value, kept);
    ++found_;
    std::memcpy(at, kept.text.data(), kept.text.size());
    return at + kept.size;
  }

 private:
  static constexpr int kIndexBits = 17;  // 65,536 numbers seldom meet in one place
  static constexpr int kWindow = 1000;
  struct alignas(32) Kept {  // two to a line of the processor's cache
    std::uint64_t bits = 0;  ///< Bits of the number; 0 for an unused entry.
    std::array<char, 23> text{'0'};
    std::uint8_t size = 1;
  };
  static std::size_t index_of(std::uint64_t bits) { return (bits * 0x9E3779B97F4A7C15ULL) >> (64 - kIndexBits); }
  [[nodiscard]] char* put_unasked(char* at, double value);
  [[nodiscard]] static char* put_and_keep(char* at, double value, Kept& kept);
  /// Stops looking up numbers for a while if too few of the current window were kept.
  void judge();

  std::vector<Kept> kept_;
  int asked_ = 0, found_ = 0;  ///< Within the current window.
  int unasked_ = 0;            ///< Coming numbers that are not looked up.
};

}  // namespace myoid::inline ground
