#include "myoid/page/packing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <type_traits>

#include <fmt/format.h>

namespace myoid::page {
namespace {

constexpr double kSteps = kPackedSteps;
constexpr std::uint32_t kMostOnes = 24;  // of Rice's code; a greater number is written in 16 bits

/// Collects bits, the highest of a byte first.
class Bits {
 public:
  void add(std::uint32_t value, unsigned count) {
    for (unsigned k = count; k-- > 0;) {
      if (free_ == 0) bytes_.push_back(0), free_ = 8;
      --free_;
      bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | (((value >> k) & 1U) << free_));
    }
  }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
  unsigned free_ = 0;
};

/// Returns the differences of a column by their order, signs folded.
std::vector<std::uint32_t> differences(const std::vector<std::uint16_t>& codes,
                                       std::size_t columns,
                                       std::size_t column,
                                       unsigned order) {
  std::vector<std::uint32_t> folded;
  std::uint16_t last = 0, slope = 0;
  for (std::size_t i = column; i < codes.size(); i += columns) {
    const auto expected = static_cast<std::uint16_t>(order == 0 ? 0 : order == 1 ? last : last + slope);
    const auto found = static_cast<std::int16_t>(static_cast<std::uint16_t>(codes[i] - expected));
    folded.push_back(found < 0 ? static_cast<std::uint32_t>(-2 * found - 1) : static_cast<std::uint32_t>(2 * found));
    slope = i == column ? 0 : static_cast<std::uint16_t>(codes[i] - last);
    last = codes[i];
  }
  return folded;
}

/// Returns the bits that Rice's code needs.
std::size_t rice_bits(const std::vector<std::uint32_t>& numbers, unsigned k) {
  std::size_t bits = 0;
  for (const std::uint32_t n : numbers) bits += (n >> k) < kMostOnes ? (n >> k) + 1 + k : kMostOnes + 16;
  return bits;
}

void add_rice(const std::vector<std::uint32_t>& numbers, unsigned k, Bits& bits) {
  for (const std::uint32_t n : numbers) {
    const std::uint32_t ones = std::min(n >> k, kMostOnes);
    bits.add((1U << ones) - 1U, ones);
    if (ones == kMostOnes) {
      bits.add(n, 16);
    } else {
      bits.add(0, 1);
      bits.add(n, k);
    }
  }
}

void add_column(const std::vector<std::uint16_t>& codes, std::size_t columns, std::size_t column, Bits& bits) {
  std::vector<std::uint32_t> best;
  std::size_t least = SIZE_MAX;
  unsigned best_order = 3, best_k = 0;
  for (unsigned order = 0; order < 3; ++order) {
    std::vector<std::uint32_t> numbers = differences(codes, columns, column, order);
    if (order == 0 && std::ranges::all_of(numbers, [](std::uint32_t n) { return n == 0; })) break;
    for (unsigned k = 0; k < 16; ++k) {
      const std::size_t needed = rice_bits(numbers, k);
      if (needed >= least) continue;
      least = needed;
      best_order = order;
      best_k = k;
      best = numbers;
    }
  }
  bits.add(best_order, 2);
  bits.add(best_k, 4);
  add_rice(best, best_k, bits);
}

/// Returns the number with seven digits, as the page writes it.
double few_digits(double x) { return std::strtod(fmt::format("{:.7g}", x).c_str(), nullptr); }

/// Encodes the numbers' bytes, little end first.
template <typename Number>
std::string base64_of(const std::vector<Number>& numbers) {
  using Word = std::conditional_t<sizeof(Number) == 2, std::uint16_t, std::uint32_t>;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(sizeof(Number) * numbers.size());
  for (const Number number : numbers) {
    const auto bits = std::bit_cast<Word>(number);
    for (std::size_t k = 0; k < sizeof(Word); ++k)
      bytes.push_back(static_cast<std::uint8_t>((bits >> (8 * k)) & 0xFFU));
  }
  return base64(std::span<const std::uint8_t>(bytes));
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = (group << 8U) | (k < count ? std::uint32_t{bytes[i + k]} : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[(group >> (18U - 6U * k)) & 63U] : '=';
  }
  return text;
}

std::string base64(const std::vector<std::uint16_t>& numbers) { return base64_of(numbers); }
std::string base64(const std::vector<std::uint32_t>& numbers) { return base64_of(numbers); }
std::string base64(const std::vector<float>& numbers) { return base64_of(numbers); }

std::string packed_codes(const std::vector<std::uint16_t>& codes, std::size_t columns) {
  Bits bits;
  bits.add(static_cast<std::uint32_t>(codes.size()), 32);
  for (std::size_t c = 0; c < columns; ++c) add_column(codes, columns, c, bits);
  return base64(std::span<const std::uint8_t>(bits.bytes()));
}

PackingBox packing_box(std::span<const Vec3> points) {
  PackingBox box;
  bool any = false;
  Vec3 upper = Vec3::Zero();
  for (const Vec3& p : points) {
    if (!p.allFinite()) continue;
    box.origin = any ? Vec3(box.origin.cwiseMin(p)) : p;
    upper = any ? Vec3(upper.cwiseMax(p)) : p;
    any = true;
  }
  const double side = (upper - box.origin).maxCoeff();
  box.step = side > 0.0 ? side / kPlaceSteps : 1.0;
  return box;
}

void pack(const PackingBox& box, const Vec3& point, std::vector<std::uint16_t>& numbers) {
  const bool known = point.allFinite();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double steps = known ? std::round((point[k] - box.origin[k]) / box.step) : 0.0;
    numbers.push_back(known ? static_cast<std::uint16_t>(std::clamp<double>(steps, 0.0, kPlaceSteps)) : kPlaceMissing);
  }
}

void pack(const Mat3& rotation, std::vector<std::uint16_t>& numbers) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  for (const double c : {q.x(), q.y(), q.z(), q.w()})
    numbers.push_back(static_cast<std::uint16_t>(std::lround(8191.0 * (1.0 + sign * c))));
}

PackedNumbers packed(const Eigen::Ref<const Eigen::VectorXd>& numbers) {
  PackedNumbers result;
  bool any = false;
  for (const double x : numbers) {
    if (!std::isfinite(x)) continue;
    result.lower = any ? std::min(result.lower, x) : x;
    result.upper = any ? std::max(result.upper, x) : x;
    any = true;
  }
  result.lower = few_digits(result.lower);
  result.upper = few_digits(result.upper);
  const double range = result.upper - result.lower;
  for (const double x : numbers) {
    result.codes.push_back(std::isfinite(x) ? pack(x - result.lower, range > 0.0 ? range : 1.0) : kPackedMissing);
  }
  return result;
}

std::uint16_t pack(double value, double top) {
  if (std::isnan(value)) return kPackedMissing;
  return static_cast<std::uint16_t>(std::lround(kSteps * std::clamp(value / top, 0.0, 1.0)));
}

}  // namespace myoid::page
