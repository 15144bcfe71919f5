#pragma once

#include <array>

#include "myoid/muscle/hill_parameters.h"

namespace myoid::fit {

/// The parts of a muscle beyond equations (2)-(4) of the source paper. All are off by default.
struct MuscleExtras {
  double pennation_angle_rad = 0.0;  ///< At the optimal fiber length; fixed width l0 sin(alpha).
  double passive_force = 0.0;        ///< Passive force of the fiber at `passive_strain`, over F_max.
  double passive_strain = 0.6;       ///< l / l0 - 1 of `passive_force`.
  double passive_shape = 4.0;        ///< Exponent of the passive force's rise.
  double length_activation = 0.0;    ///< gamma: optimal length l0 (1 + gamma (1 - a)).
  double tendon_strain = 0.0;        ///< Strain of the tendon at F_max; 0: rigid.
  double activation_share = 1.0;     ///< Activation of the muscle over that of its EMG channel.
};

/// Indices of a muscle's numbers in MuscleValues and in derivatives. The first eight are muscle::kHillFields.
enum MuscleField : int {
  kMaxForce,
  kFiberLength,
  kWidth,
  kCurvature,
  kProduct,
  kPlateau,
  kSpeed,
  kSlack,
  kPennation,
  kPassiveForce,
  kPassiveStrain,
  kPassiveShape,
  kLengthActivation,
  kTendonStrain,
  kShare,
  kMuscleFieldCount
};
using MuscleValues = std::array<double, kMuscleFieldCount>;

[[nodiscard]] MuscleValues muscle_values(const muscle::HillParameters<double>& hill, const MuscleExtras& extras = {});
[[nodiscard]] muscle::HillParameters<double> hill_parameters(const MuscleValues& values);

/// Tension of a muscle-tendon unit and its partial derivatives.
struct Tension {
  double force_n = 0.0;
  std::array<double, kMuscleFieldCount> by_field{};  ///< Includes activation_share.
  double by_activation = 0.0;                        ///< By the channel's activation, before activation_share.
  double by_length = 0.0;                            ///< By the musculotendon length [N/m].
  double by_velocity = 0.0;                          ///< By its rate [N s/m].
  double strain = 0.0;                               ///< Of an elastic tendon.
};

/// Returns the tension [N] at a channel's activation, musculotendon length [m] and rate [m/s]:
///
///   F = F_max [ a f_l(l; l0 (1 + gamma (1 - a))) f_v(v) + f_p(l) ] cos(alpha),
///   a = share * activation,   f_p = c (exp(k s(l/l0 - 1) / e) - 1) / (exp(k) - 1)
///
/// s(x) = x above d = 0.05, 0 below -d, between (x + d)^2 / (4 d), 0.2 % of c at 0: a search ends at a corner.
/// f_l and f_v as in muscle/force_length.h and force_velocity.h; the width l_sh does not grow with
/// the optimal length. Rigid tendon: l cos(alpha) = l_mt - l_ts, v = v_mt cos(alpha). With a tendon
/// strain e0 > 0 at F_max (and l_ts > 0) the tendon is elastic and quasi-static,
///
///   F / F_max = 0.2 (exp(ln(6) strain / e0) - 1),   l cos(alpha) = l_mt - l_ts (1 + strain),
///
/// solved to round-off for every sample; v leaves out the rate at which the tendon stretches. Derivatives are exact
/// (implicit function theorem). Where the tendon is slack (l_mt <= l_ts with pennation) the tension is 0.
[[nodiscard]] Tension tension(double activation, double length_m, double velocity_mps, const MuscleValues& values);

/// Returns true if only the paper's law, the share, an optimal length that changes with the activation and a tendon,
/// rigid or elastic, act; `plain_tension` is then faster and gives the same tension.
[[nodiscard]] bool is_plain(const MuscleValues& values);

/// Returns true for the fields by which `plain_tension` sets the derivative.
[[nodiscard]] constexpr bool is_plain_field(int field) {
  return field <= kSlack || field == kLengthActivation || field == kTendonStrain || field == kShare;
}

/// Computes `tension` where `is_plain`; leaves the derivatives by other fields as they are. `out.strain` is where the
/// search for an elastic tendon's strain begins: that of the sample before saves steps.
void plain_tension(double activation, double length_m, double velocity_mps, const MuscleValues& values, Tension& out);

/// Returns `tension(...).force_n` alone, by `plain_tension` where `is_plain`.
[[nodiscard]] double tension_n(double activation, double length_m, double velocity_mps, const MuscleValues& values);

}  // namespace myoid::fit
