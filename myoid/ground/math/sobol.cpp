#include "myoid/ground/math/sobol.h"

#include <array>
#include <bit>
#include <vector>

#include <boost/random/sobol.hpp>
#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"

namespace myoid::inline ground::math {
namespace {

constexpr int kBits = 32;

/// A random affine map of the digits of one dimension: digit i (1 = half) of the image is digit i
/// plus random ones of the digits before it, plus a random digit.
class Scramble {
 public:
  Scramble(std::uint64_t seed, int dimension) : random_(seed, static_cast<std::uint64_t>(dimension)) {
    for (int i = 0; i < kBits; ++i) {
      const std::uint32_t diagonal = 1U << (kBits - 1 - i);
      const std::uint32_t before = i == 0 ? 0U : ~0U << (kBits - i);
      rows_[static_cast<std::size_t>(i)] = diagonal | (word() & before);
    }
    shift_ = word();
  }

  [[nodiscard]] std::uint32_t operator()(std::uint32_t x) const {
    std::uint32_t image = 0;
    for (const std::uint32_t row : rows_) image = image << 1 | (std::popcount(x & row) & 1U);
    return image ^ shift_;
  }

 private:
  std::uint32_t word() { return static_cast<std::uint32_t>(random_.bits() >> 32); }

  Random random_;
  std::array<std::uint32_t, kBits> rows_{};
  std::uint32_t shift_ = 0;
};

}  // namespace

Eigen::MatrixXd sobol_points(Eigen::Index count, int dimensions, const SobolOptions& options) {
  if (dimensions < 1 || dimensions > kSobolMaxDimensions) {
    throw InvalidInput(fmt::format("sobol: {} dimensions; 1 to {} are tabulated", dimensions, kSobolMaxDimensions));
  }
  constexpr Eigen::Index kMost = Eigen::Index{1} << kBits;
  if (count < 0 || options.first < 0 || count > kMost || options.first > kMost - count) {
    throw InvalidInput(
        fmt::format("sobol: {} points from index {}; the sequence has 2^{} points", count, options.first, kBits));
  }
  std::vector<Scramble> scrambles;
  if (options.scramble_seed) {
    for (int d = 0; d < dimensions; ++d) scrambles.emplace_back(*options.scramble_seed, d);
  }
  // Boost leaves the origin out: its k-th point is the sequence's point k + 1.
  boost::random::sobol_engine<std::uint64_t, kBits> engine(static_cast<std::size_t>(dimensions));
  if (options.first > 1) engine.seed(static_cast<std::uint64_t>(options.first - 1));
  Eigen::MatrixXd points(count, dimensions);
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool origin = options.first + i == 0;
    for (int d = 0; d < dimensions; ++d) {
      const auto x = origin ? 0U : static_cast<std::uint32_t>(engine());
      points(i, d) = scrambles.empty() ? x * 0x1.0p-32 : (scrambles[static_cast<std::size_t>(d)](x) + 0.5) * 0x1.0p-32;
    }
  }
  return points;
}

}  // namespace myoid::inline ground::math
