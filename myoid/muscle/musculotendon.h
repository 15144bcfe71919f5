#pragma once

#include <array>

#include "myoid/muscle/musculotendon_unit.h"

namespace myoid::muscle {

/// States that the mode integrates: rigid 0, equilibrium 1 (l_m), mass 2 (l_m, then dl_m/dt).
[[nodiscard]] constexpr int state_size(TendonMode mode) {
  return mode == TendonMode::rigid ? 0 : mode == TendonMode::equilibrium ? 1 : 2;
}

/// What drives a unit: activation 0..1, length [m] and velocity [m/s] of the whole path.
template <typename T = double>
struct MusculotendonInput {
  T activation{};
  T length_m{};
  T velocity_mps{};
};

/// The states; a mode ignores those it does not have.
template <typename T = double>
struct MusculotendonState {
  T fiber_length_m{};
  T fiber_velocity_mps{};
};

/// The right-hand side and the force on the skeleton: what an integrator calls. No allocation.
template <typename T = double>
struct MusculotendonRate {
  T fiber_length_rate_mps{};     ///< dl_m/dt, in every mode (rigid: from the path).
  T fiber_velocity_rate_mps2{};  ///< d2l_m/dt2 in mode `mass`, else 0.
  T tendon_force_n{};            ///< F_t >= 0, along the path.
};
template <typename T>
[[nodiscard]] MusculotendonRate<T> musculotendon_rate(const Musculotendon<T>& unit,
                                                      const MusculotendonInput<T>& input,
                                                      const MusculotendonState<T>& state);

/// Everything there is to know at one instant. Powers are those *given*: the contractile element's
/// is positive in shortening, a spring's when it relaxes, the viscous one's never. They add up:
///   active + passive + viscous + tendon + kinetic = musculotendon power = -F_t dl_mt/dt.
/// Energies are those stored, zero in a slack spring and a fiber at rest: power = -dE/dt.
template <typename T = double>
struct MusculotendonOutput {
  T fiber_length_m{}, fiber_velocity_mps{}, fiber_acceleration_mps2{};
  T cos_pennation{};
  T tendon_length_m{}, tendon_velocity_mps{};
  T length_multiplier{}, velocity_multiplier{};              ///< f_l, f_v
  T active_force_n{}, passive_force_n{}, viscous_force_n{};  ///< Along the fiber.
  T fiber_force_n{};                                         ///< Their sum, F_m.
  T tendon_force_n{};                                        ///< F_t
  T active_power_w{}, passive_power_w{}, viscous_power_w{};
  T tendon_power_w{}, kinetic_power_w{}, musculotendon_power_w{};
  T passive_energy_j{}, tendon_energy_j{}, kinetic_energy_j{};
  double fiber_stiffness_npm = 0.0;   ///< dF_m/dl_m at this activation and velocity.
  double tendon_stiffness_npm = 0.0;  ///< dF_t/dl_t; infinite is given as 0 in mode `rigid`.
  bool slack = false;                 ///< The tendon pulls nothing.
  bool at_shortest = false;           ///< The fiber leans on its lower limit.
  bool floored = false;               ///< a f_l was raised to `kLeastStrength`.
};
template <typename T>
[[nodiscard]] MusculotendonOutput<T> musculotendon_output(const Musculotendon<T>& unit,
                                                          const MusculotendonInput<T>& input,
                                                          const MusculotendonState<T>& state);

/// A state in which the unit is steady under a constant input: the tendon's length does not change,
/// so that v = dl_mt/dt cos(alpha), and F_t = F_m cos(alpha) to round-off. Of several, a stable
/// one: where the tendon's pull falls faster with l_m than the fiber's. With a slack tendon the
/// fiber lies at the length that leaves it just slack. T = Jet: with the derivatives of the
/// solution.
template <typename T>
[[nodiscard]] MusculotendonState<T> equilibrium_state(const Musculotendon<T>& unit,
                                                      const MusculotendonInput<T>& input);

/// Quantities at whose zeros the right-hand side has a kink or a jump in its derivatives, for the
/// event location of an integrator: [0] tendon strain (slack below 0), [1] v / v_max, [2] 1 + v /
/// v_max, [3] l_m / l0 - 1 (passive onset), [4] l_m over its lower limit, minus 1, [5] v over where
/// an upper tangent begins, or +1. Laws without the kink make the zero harmless.
inline constexpr int kMusculotendonEventCount = 6;
[[nodiscard]] std::array<double, kMusculotendonEventCount> musculotendon_events(
    const Musculotendon<double>& unit,
    const MusculotendonInput<double>& input,
    const MusculotendonState<double>& state);

/// In the undamped equilibrium, a f_l is not taken below this.
inline constexpr double kLeastStrength = 0.01;

}  // namespace myoid::muscle

#include "myoid/muscle/musculotendon_inl.h"
