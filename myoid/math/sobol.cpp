#include "myoid/math/sobol.h"

#include <array>
#include <bit>
#include <vector>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/random.h"

namespace myoid::math {
namespace {

constexpr int kBits = 32;
using Directions = std::array<std::uint32_t, kBits>;

/// One dimension of the table: degree and inner coefficients of its primitive polynomial
/// x^s + a_1 x^(s-1) + ... + 1 (a in binary), and the first s odd integers m_k < 2^k.
struct Row {
  int degree;
  std::uint32_t inner;
  std::array<std::uint32_t, 9> first;
};

/// Dimensions 2 to 64 of "new-joe-kuo-6.21201": S. Joe and F. Y. Kuo, Constructing Sobol sequences
/// with better two-dimensional projections, SIAM J. Sci. Comput. 30 (2008) 2635-2654.
constexpr std::array<Row, 63> kRows{{{1, 0, {1}},
                                     {2, 1, {1, 3}},
                                     {3, 1, {1, 3, 1}},
                                     {3, 2, {1, 1, 1}},
                                     {4, 1, {1, 1, 3, 3}},
                                     {4, 4, {1, 3, 5, 13}},
                                     {5, 2, {1, 1, 5, 5, 17}},
                                     {5, 4, {1, 1, 5, 5, 5}},
                                     {5, 7, {1, 1, 7, 11, 19}},
                                     {5, 11, {1, 1, 5, 1, 1}},
                                     {5, 13, {1, 1, 1, 3, 11}},
                                     {5, 14, {1, 3, 5, 5, 31}},
                                     {6, 1, {1, 3, 3, 9, 7, 49}},
                                     {6, 13, {1, 1, 1, 15, 21, 21}},
                                     {6, 16, {1, 3, 1, 13, 27, 49}},
                                     {6, 19, {1, 1, 1, 15, 7, 5}},
                                     {6, 22, {1, 3, 1, 15, 13, 25}},
                                     {6, 25, {1, 1, 5, 5, 19, 61}},
                                     {7, 1, {1, 3, 7, 11, 23, 15, 103}},
                                     {7, 4, {1, 3, 7, 13, 13, 15, 69}},
                                     {7, 7, {1, 1, 3, 13, 7, 35, 63}},
                                     {7, 8, {1, 3, 5, 9, 1, 25, 53}},
                                     {7, 14, {1, 3, 1, 13, 9, 35, 107}},
                                     {7, 19, {1, 3, 1, 5, 27, 61, 31}},
                                     {7, 21, {1, 1, 5, 11, 19, 41, 61}},
                                     {7, 28, {1, 3, 5, 3, 3, 13, 69}},
                                     {7, 31, {1, 1, 7, 13, 1, 19, 1}},
                                     {7, 32, {1, 3, 7, 5, 13, 19, 59}},
                                     {7, 37, {1, 1, 3, 9, 25, 29, 41}},
                                     {7, 41, {1, 3, 5, 13, 23, 1, 55}},
                                     {7, 42, {1, 3, 7, 3, 13, 59, 17}},
                                     {7, 50, {1, 3, 1, 3, 5, 53, 69}},
                                     {7, 55, {1, 1, 5, 5, 23, 33, 13}},
                                     {7, 56, {1, 1, 7, 7, 1, 61, 123}},
                                     {7, 59, {1, 1, 7, 9, 13, 61, 49}},
                                     {7, 62, {1, 3, 3, 5, 3, 55, 33}},
                                     {8, 14, {1, 3, 1, 15, 31, 13, 49, 245}},
                                     {8, 21, {1, 3, 5, 15, 31, 59, 63, 97}},
                                     {8, 22, {1, 3, 1, 11, 11, 11, 77, 249}},
                                     {8, 38, {1, 3, 1, 11, 27, 43, 71, 9}},
                                     {8, 47, {1, 1, 7, 15, 21, 11, 81, 45}},
                                     {8, 49, {1, 3, 7, 3, 25, 31, 65, 79}},
                                     {8, 50, {1, 3, 1, 1, 19, 11, 3, 205}},
                                     {8, 52, {1, 1, 5, 9, 19, 21, 29, 157}},
                                     {8, 56, {1, 3, 7, 11, 1, 33, 89, 185}},
                                     {8, 67, {1, 3, 3, 3, 15, 9, 79, 71}},
                                     {8, 70, {1, 3, 7, 11, 15, 39, 119, 27}},
                                     {8, 84, {1, 1, 3, 1, 11, 31, 97, 225}},
                                     {8, 97, {1, 1, 1, 3, 23, 43, 57, 177}},
                                     {8, 103, {1, 3, 7, 7, 17, 17, 37, 71}},
                                     {8, 115, {1, 3, 1, 5, 27, 63, 123, 213}},
                                     {8, 122, {1, 1, 3, 5, 11, 43, 53, 133}},
                                     {9, 8, {1, 3, 5, 5, 29, 17, 47, 173, 479}},
                                     {9, 13, {1, 3, 3, 11, 3, 1, 109, 9, 69}},
                                     {9, 16, {1, 1, 1, 5, 17, 39, 23, 5, 343}},
                                     {9, 22, {1, 3, 1, 5, 25, 15, 31, 103, 499}},
                                     {9, 25, {1, 1, 1, 11, 11, 17, 63, 105, 183}},
                                     {9, 44, {1, 1, 5, 11, 9, 29, 97, 231, 363}},
                                     {9, 47, {1, 1, 5, 15, 19, 45, 41, 7, 383}},
                                     {9, 52, {1, 3, 7, 7, 31, 19, 83, 137, 221}},
                                     {9, 55, {1, 1, 1, 3, 23, 15, 111, 223, 83}},
                                     {9, 59, {1, 1, 5, 13, 31, 15, 55, 25, 161}},
                                     {9, 62, {1, 1, 3, 13, 25, 47, 39, 87, 257}}}};

/// v_k = m_k 2^(32-k): the k-th digit of a point's index adds v_k, modulo 2.
Directions directions(int dimension) {
  Directions v{};
  if (dimension == 0) {
    for (int k = 0; k < kBits; ++k) v[static_cast<std::size_t>(k)] = 1U << (kBits - 1 - k);
    return v;
  }
  const Row& row = kRows[static_cast<std::size_t>(dimension - 1)];
  const auto s = static_cast<std::size_t>(row.degree);
  for (std::size_t k = 0; k < kBits; ++k) {
    if (k < s) {
      v[k] = row.first[k] << (kBits - 1 - k);
      continue;
    }
    v[k] = v[k - s] ^ (v[k - s] >> s);
    for (std::size_t i = 1; i < s; ++i) {
      if ((row.inner >> (s - 1 - i)) & 1U) v[k] ^= v[k - i];
    }
  }
  return v;
}

/// Lower triangular in the digits, ones on the diagonal: digit i (1 = half) of the image is digit i
/// plus random ones of the digits before it.
void scramble(Directions& v, Random& random) {
  std::array<std::uint32_t, kBits> matrix{};
  for (int i = 0; i < kBits; ++i) {
    const std::uint32_t diagonal = 1U << (kBits - 1 - i);
    const std::uint32_t before = i == 0 ? 0U : ~0U << (kBits - i);
    matrix[static_cast<std::size_t>(i)] =
        diagonal | (static_cast<std::uint32_t>(random.bits() >> 32) & before);
  }
  for (std::uint32_t& direction : v) {
    std::uint32_t image = 0;
    for (int i = 0; i < kBits; ++i) {
      const auto parity = static_cast<std::uint32_t>(
          std::popcount(direction & matrix[static_cast<std::size_t>(i)]) & 1);
      image |= parity << (kBits - 1 - i);
    }
    direction = image;
  }
}

}  // namespace

Eigen::MatrixXd sobol_points(Eigen::Index count, int dimensions, const SobolOptions& options) {
  if (dimensions < 1 || dimensions > kSobolMaxDimensions) {
    throw InvalidInput(fmt::format("sobol: {} dimensions; 1 to {} are tabulated", dimensions,
                                   kSobolMaxDimensions));
  }
  constexpr Eigen::Index kMost = Eigen::Index{1} << kBits;
  if (count < 0 || options.first < 0 || count > kMost || options.first > kMost - count) {
    throw InvalidInput(fmt::format("sobol: {} points from index {}; the sequence has 2^{} points",
                                   count, options.first, kBits));
  }
  Eigen::MatrixXd points(count, dimensions);
  for (int d = 0; d < dimensions; ++d) {
    Directions v = directions(d);
    std::uint32_t x = 0;
    double offset = 0.0;
    if (options.scramble_seed) {
      Random random(*options.scramble_seed, static_cast<std::uint64_t>(d));
      scramble(v, random);
      x = static_cast<std::uint32_t>(random.bits() >> 32);
      offset = 0.5;
    }
    // Point n is the sum of the directions at the ones of the Gray code of n.
    const auto first = static_cast<std::uint64_t>(options.first);
    const std::uint64_t gray = first ^ (first >> 1);
    for (std::size_t k = 0; k < kBits; ++k) {
      if ((gray >> k) & 1U) x ^= v[k];
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      points(i, d) = (static_cast<double>(x) + offset) * 0x1.0p-32;
      // Next: one digit of the Gray code changes, at the lowest zero of the index.
      const int changed = std::countr_one(first + static_cast<std::uint64_t>(i));
      if (changed < kBits) x ^= v[static_cast<std::size_t>(changed)];
    }
  }
  return points;
}

}  // namespace myoid::math
