#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

namespace myoid::inline ground::math {

inline constexpr int kSobolMaxDimensions = 64;

struct SobolOptions {
  Eigen::Index first = 0;  ///< Index of the first point returned; 0 is the origin if unscrambled.
  /// If set, scrambles the points by a random linear scramble (Matousek 1998: lower triangular binary matrix on the
  /// digits of each dimension) and a digital shift, which keep every balance property of the sequence.
  std::optional<std::uint64_t> scramble_seed;
};

/// Returns Sobol points in the unit cube, one per row: count x dimensions, in Gray-code order (Antonov and Saleev
/// 1979), with the direction numbers "new-joe-kuo-6" of Joe and Kuo (2008). Unscrambled points are multiples of 2^-32
/// in [0, 1); point 0 is the origin and point 1 the center. Scrambled points are in the open interval, each uniform in
/// the cube. Of every 2^k points from an index that 2^k divides, each of 2^k equal slices of each axis holds one.
/// Throws InvalidInput unless 1 <= dimensions <= 64 and 0 <= first, count and first + count <= 2^32.
[[nodiscard]] Eigen::MatrixXd sobol_points(Eigen::Index count, int dimensions, const SobolOptions& options = {});

}  // namespace myoid::inline ground::math
