#pragma once

#include <cstdint>
#include <random>
#include <string_view>

#include <Eigen/Core>

namespace myoid::inline ground::math {

/// Pseudorandom numbers that are the same on every machine with IEEE doubles: the standard fixes
/// the engine (std::mt19937_64), and this class the transformations.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// One of many independent streams of a seed. Give every task of a parallel loop its own stream
  /// (its index) and the results do not depend on the thread count.
  Random(std::uint64_t seed, std::uint64_t stream);

  /// Returns 64 random bits.
  std::uint64_t bits() { return engine_(); }
  /// Returns a uniform number in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }
  /// Returns a uniform number in [lower, upper).
  double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }
  /// Returns a uniform integer in 0 .. count-1, without bias. Throws InvalidInput if count < 1.
  Eigen::Index below(Eigen::Index count);
  /// Returns a standard normal number, by the method of Box and Muller.
  double normal();
  /// Returns `count` standard normal numbers.
  Eigen::VectorXd normals(Eigen::Index count);

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

/// Returns a seed for one purpose, from the seed of the whole: streams of different names are independent, so a further
/// trial or channel does not change the noise of the others. FNV-1a of the name, mixed by the finalizer of SplitMix64.
[[nodiscard]] std::uint64_t seed_for(std::uint64_t seed, std::string_view purpose);

}  // namespace myoid::inline ground::math
