#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/geometry.h"

namespace myoid::report {

/// Encodes bytes in base64 (RFC 4648, with padding).
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);
/// Encodes the numbers' bytes in base64, little end first.
[[nodiscard]] std::string base64(const std::vector<std::uint16_t>& numbers);
[[nodiscard]] std::string base64(const std::vector<std::uint32_t>& numbers);
[[nodiscard]] std::string base64(const std::vector<float>& numbers);

/// The 16-bit code of a value that is not a number.
inline constexpr std::uint16_t kPackedMissing = 65535;

/// A cube of space in 65535 steps along each axis: p = origin + step * number.
struct PackingBox {
  Vec3 origin = Vec3::Zero();
  double step = 1.0;  ///< Positions are right within half a step.
};
/// Returns the smallest cube about all points; points with NaN do not count.
[[nodiscard]] PackingBox packing_box(std::span<const Vec3> points);
/// Appends the three numbers of a point; kPackedMissing for a point with NaN.
void pack(const PackingBox& box, const Vec3& point, std::vector<std::uint16_t>& numbers);
/// Packs the unit quaternion x, y, z, w of a rotation, as 32767 (1 + component) rounded: components
/// are right within 1.6e-5.
void pack(const Mat3& rotation, std::vector<std::uint16_t>& numbers);
/// Numbers in 65534 steps between the least and the greatest of them: right within half a step.
struct PackedNumbers {
  double lower = 0.0, upper = 0.0;
  std::vector<std::uint16_t> codes;  ///< value = lower + (upper - lower) code / 65534.
};
/// Packs the numbers; one that is not finite becomes kPackedMissing.
[[nodiscard]] PackedNumbers packed(const Eigen::Ref<const Eigen::VectorXd>& numbers);
/// Packs a value of 0 .. top in 65534 steps; a value beyond becomes the nearest end, NaN kPackedMissing.
[[nodiscard]] std::uint16_t pack(double value, double top);

}  // namespace myoid::report
