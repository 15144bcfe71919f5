#include "myoid/math/random.h"

#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::math {
namespace {

/// Advances `x` and returns mixed bits: the finalizer of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t split_mix(std::uint64_t& x) {
  x += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = x;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream) {
  // The seed is mixed before the stream enters: neighboring seeds and streams share nothing.
  std::uint64_t from_seed = seed;
  std::uint64_t from_stream = stream ^ 0xD1B54A32D192ED03ULL;
  std::uint64_t x = split_mix(from_seed) ^ std::rotl(split_mix(from_stream), 32);
  for (std::uint64_t& word : state_) word = split_mix(x);
}

std::uint64_t Random::bits() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

Eigen::Index Random::below(Eigen::Index count) {
  if (count < 1) throw InvalidInput(fmt::format("random: no integer below {}", count));
  const auto n = static_cast<std::uint64_t>(count);
  // Bits above the largest multiple of n are drawn again.
  const std::uint64_t limit = UINT64_MAX - (UINT64_MAX % n + 1) % n;
  std::uint64_t drawn = bits();
  while (drawn > limit) drawn = bits();
  return static_cast<Eigen::Index>(drawn % n);
}

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double u = 0.0, v = 0.0, square = 0.0;
  do {
    u = 2.0 * uniform() - 1.0;
    v = 2.0 * uniform() - 1.0;
    square = u * u + v * v;
  } while (square >= 1.0 || square == 0.0);
  const double factor = std::sqrt(-2.0 * std::log(square) / square);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

}  // namespace myoid::math
