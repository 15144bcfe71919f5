#pragma once

#include <cstdint>
#include <random>
#include <string_view>

#include <Eigen/Core>

namespace myoid::simulation {

/// A seeded stream of random numbers, equal on every machine with IEEE doubles, because the
/// standard fixes the engine (std::mt19937_64), and this class the transformations.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Returns a number in [0, 1), a multiple of 2^-53.
  [[nodiscard]] double uniform();
  /// Returns a number in [lower, upper).
  [[nodiscard]] double uniform(double lower, double upper);
  /// Returns a standard normal number, by the method of Box and Muller.
  [[nodiscard]] double normal();
  /// Returns `count` standard normal numbers.
  [[nodiscard]] Eigen::VectorXd normals(Eigen::Index count);

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

/// Returns a seed for one purpose, from the seed of the whole: streams of different names are
/// independent, so a further trial or channel does not change the noise of the others. FNV-1a of
/// the name, mixed by the finalizer of splitmix64.
[[nodiscard]] std::uint64_t seed_for(std::uint64_t seed, std::string_view purpose);

}  // namespace myoid::simulation
