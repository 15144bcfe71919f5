#include "myoid/ground/math/random.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::inline ground::math {
namespace {

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : engine_(mixed(mixed(seed + kGolden) + (stream + 1) * kGolden)) {}

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
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));  // 1 - u is never 0
  const double angle_rad = 2.0 * kPi * uniform();
  spare_ = radius * std::sin(angle_rad);
  has_spare_ = true;
  return radius * std::cos(angle_rad);
}

Eigen::VectorXd Random::normals(Eigen::Index count) {
  Eigen::VectorXd result(count);
  for (double& value : result) value = normal();
  return result;
}

std::uint64_t seed_for(std::uint64_t seed, std::string_view purpose) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : purpose) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return mixed(hash + (seed + 1) * kGolden);
}

}  // namespace myoid::inline ground::math
