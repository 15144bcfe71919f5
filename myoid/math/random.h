#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace myoid::math {

/// Pseudorandom numbers that are the same on every machine and compiler: xoshiro256** (Blackman
/// and Vigna 2021), its state filled by SplitMix64 from `seed` and `stream`. Give every task of a
/// parallel loop its own stream (its index) and the results do not depend on the thread count.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  /// Returns 64 random bits.
  std::uint64_t bits();
  /// Returns a uniform number in [0, 1), a multiple of 2^-53.
  double uniform();
  /// Returns a uniform integer in 0 .. count-1, without bias. Throws InvalidInput if count < 1.
  Eigen::Index below(Eigen::Index count);
  /// Returns a standard normal number, by the polar method.
  double normal();

 private:
  std::array<std::uint64_t, 4> state_{};
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace myoid::math
