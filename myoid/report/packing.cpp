#include "myoid/report/packing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

namespace myoid::report {
namespace {

constexpr double kSteps = 65534.0;

/// Encodes the numbers' bytes, little end first.
template <typename Number>
std::string base64_of(const std::vector<Number>& numbers) {
  using Bits = std::conditional_t<sizeof(Number) == 2, std::uint16_t, std::uint32_t>;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(sizeof(Number) * numbers.size());
  for (const Number number : numbers) {
    const auto bits = std::bit_cast<Bits>(number);
    for (std::size_t k = 0; k < sizeof(Bits); ++k)
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
  box.step = side > 0.0 ? side / kSteps : 1.0;
  return box;
}

void pack(const PackingBox& box, const Vec3& point, std::vector<std::uint16_t>& numbers) {
  const bool known = point.allFinite();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double steps = known ? std::round((point[k] - box.origin[k]) / box.step) : 0.0;
    numbers.push_back(known ? static_cast<std::uint16_t>(std::clamp(steps, 0.0, kSteps)) : kPackedMissing);
  }
}

void pack(const Mat3& rotation, std::vector<std::uint16_t>& numbers) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  for (const double c : {q.x(), q.y(), q.z(), q.w()})
    numbers.push_back(static_cast<std::uint16_t>(std::lround(32767.0 * (1.0 + c))));
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

}  // namespace myoid::report
