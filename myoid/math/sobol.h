#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

namespace myoid::math {

inline constexpr int kSobolMaxDimensions = 64;

struct SobolOptions {
  Eigen::Index first = 0;  ///< Index of the first point returned; 0 is the origin if unscrambled.
  /// Set: a random linear scramble (Matousek 1998: lower triangular binary matrix on the digits
  /// of each dimension) and a digital shift, which keep every balance property of the sequence.
  std::optional<std::uint64_t> scramble_seed;
};

/// Sobol points in the unit cube, one per row: count x dimensions, in Gray-code order (Antonov and
/// Saleev 1979), direction numbers "new-joe-kuo-6" of Joe and Kuo (2008). Unscrambled: multiples of
/// 2^-32 in [0, 1), point 0 the origin, point 1 the center. Scrambled: in the open interval, each
/// point uniform in the cube. Every 2^k points from an index that 2^k divides fill each of 2^k
/// equal slices of each axis once. Throws InvalidInput unless 1 <= dimensions <= 64 and 0 <= first,
/// count and first + count <= 2^32.
[[nodiscard]] Eigen::MatrixXd sobol_points(Eigen::Index count,
                                           int dimensions,
                                           const SobolOptions& options = {});

}  // namespace myoid::math
