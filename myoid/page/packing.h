#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/geometry.h"

namespace myoid::page {

/// Encodes bytes in base64 (RFC 4648, with padding).
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);
/// Encodes the numbers' bytes in base64, little end first.
[[nodiscard]] std::string base64(const std::vector<std::uint16_t>& numbers);
[[nodiscard]] std::string base64(const std::vector<std::uint32_t>& numbers);
[[nodiscard]] std::string base64(const std::vector<float>& numbers);

/// Number of steps of a range of values, twenty for a pixel of a plot, and the code of a value that is not a number.
inline constexpr int kPackedSteps = 4094;
inline constexpr std::uint16_t kPackedMissing = 4095;
/// Number of steps of a side of space, and the code of a place that is not known.
inline constexpr int kPlaceSteps = 16382;
inline constexpr std::uint16_t kPlaceMissing = 16383;

/// Encodes rows of `columns` codes in base64. Of each column its differences of order 0, 1 or 2 along the rows are
/// written, by the order that needs the fewest bits:
///
///   32 bits   number of codes
///   columns, each:  2 bits order, 4 bits k, then the differences, modulo 2^16, signs folded (0, -1, 1, -2, ...), in
///                   Rice's code: n >> k ones, a zero, the last k bits of n; of 24 ones and more 24 ones and 16 bits.
///                   Order 3: all codes are 0.
///
/// Bits fill bytes from the highest.
[[nodiscard]] std::string packed_codes(const std::vector<std::uint16_t>& codes, std::size_t columns = 1);

/// A cube of space in steps along each axis: p = origin + step * number.
struct PackingBox {
  Vec3 origin = Vec3::Zero();
  double step = 1.0;  ///< Positions are right within half a step.
};
/// Returns the smallest cube about all points; points with NaN do not count.
[[nodiscard]] PackingBox packing_box(std::span<const Vec3> points);
/// Appends the three numbers of a point; kPlaceMissing for a point with NaN.
void pack(const PackingBox& box, const Vec3& point, std::vector<std::uint16_t>& numbers);
/// Packs the unit quaternion x, y, z, w of a rotation, w >= 0, as 8191 (1 + component) rounded: components are right
/// within 6.2e-5.
void pack(const Mat3& rotation, std::vector<std::uint16_t>& numbers);
/// Numbers in steps between the least and the greatest of them: right within half a step.
struct PackedNumbers {
  double lower = 0.0, upper = 0.0;
  std::vector<std::uint16_t> codes;  ///< value = lower + (upper - lower) code / kPackedSteps.
};
/// Packs the numbers; one that is not finite becomes kPackedMissing.
[[nodiscard]] PackedNumbers packed(const Eigen::Ref<const Eigen::VectorXd>& numbers);
/// Packs a value of 0 .. top in steps; a value beyond becomes the nearest end, NaN kPackedMissing.
[[nodiscard]] std::uint16_t pack(double value, double top);

}  // namespace myoid::page
