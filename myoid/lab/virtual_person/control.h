#pragma once

#include <array>
#include <cmath>
#include <string_view>

namespace myoid::lab {

/// The muscles of the built-in arm, in this order everywhere in this folder.
inline constexpr std::array<std::string_view, 4> kArmMuscles = {"BIC", "BRA", "BRD", "TRI"};
enum MuscleIndex : std::size_t { kBiceps, kBrachialis, kBrachioradialis, kTriceps };

/// A number per muscle, in the order of kArmMuscles.
using PerMuscle = std::array<double, 4>;

/// Interpolates every number by a straight line.
template <std::size_t N>
[[nodiscard]] std::array<double, N> lerp(const std::array<double, N>& a, const std::array<double, N>& b, double share) {
  std::array<double, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = std::lerp(a[i], b[i], share);
  return result;
}

/// The virtual person's choices that mechanics leaves open.
struct Coordination {
  double brachioradialis = 0.0;  ///< ln(BRD / BIC activation).
  double brachialis = 0.0;       ///< ln(BRA / BIC activation).
  double co_contraction = 0.0;   ///< Activation of the antagonist while the agonists work.
  /// Reduces the triceps' co-contraction at low torque, because people do not tense the flexors to hold a stretched arm
  /// at rest. The co-contraction is then a share of the weaker side's capacity, 0.3 of this share without a load and
  /// all of it under load: c min(C_TRI, C_flexors) (0.3 + 0.7 T^2 / (T^2 + (3 N m)^2)).
  bool eased = false;
};

/// Returns the activations of the flexors relative to BIC; TRI has 1.
[[nodiscard]] PerMuscle weights(const Coordination& coordination);

/// Returns activations that exert exactly `torque_nm`, given the torque of each muscle at full
/// activation, `capacity_nm` (signed: flexors positive, TRI negative). The triceps gets c plus the
/// activation that extension needs, the flexors the rest in their proportions:
///
///   a_TRI = c + p(-T) / |C_TRI|   (c: see `eased`),
///   a_i = u w_i,   u sum_i w_i C_i = T + a_TRI |C_TRI|
///
/// with p(x) = (x + sqrt(x^2 + (1 N m)^2)) / 2 > 0, smooth where the torque changes sign. All activations are positive
/// and not limited to 1; the caller checks the limit. Precondition: no capacity is zero or of the wrong sign.
[[nodiscard]] PerMuscle activations_for(double torque_nm,
                                        const PerMuscle& capacity_nm,
                                        const Coordination& coordination);

}  // namespace myoid::lab
