#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/geometry.h"

namespace myoid::report {

/// Base64 (RFC 4648, with padding).
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);
/// Base64 of the numbers' bytes, little end first.
[[nodiscard]] std::string base64(const std::vector<std::uint16_t>& numbers);
[[nodiscard]] std::string base64(const std::vector<std::uint32_t>& numbers);
[[nodiscard]] std::string base64(const std::vector<float>& numbers);

/// The 16-bit code of a value that is not a number.
inline constexpr std::uint16_t kPackedMissing = 65535;

/// A cube of space in 65535 steps along each axis: p = origin + step * number.
struct PackingBox {
  Vec3 origin = Vec3::Zero();
  double step = 1.0;  ///< Positions are right within half of it.
};
/// The smallest one about all points; missing (NaN) ones aside.
[[nodiscard]] PackingBox packing_box(std::span<const Vec3> points);
/// Appends the three numbers of a point; of one with a NaN, kPackedMissing.
void pack(const PackingBox& box, const Vec3& point, std::vector<std::uint16_t>& numbers);
/// The unit quaternion x, y, z, w of a rotation, as 32767 (1 + component) rounded: components are
/// right within 1.6e-5.
void pack(const Mat3& rotation, std::vector<std::uint16_t>& numbers);
/// A value of 0 .. top in 65534 steps; beyond, its nearest end; NaN: kPackedMissing.
[[nodiscard]] std::uint16_t pack(double value, double top);

}  // namespace myoid::report
