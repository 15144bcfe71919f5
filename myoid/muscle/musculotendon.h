#pragma once

#include <array>

#include "myoid/muscle/musculotendon_parameters.h"
#include "myoid/muscle/normalized_curves.h"
#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// Cosine of the greatest pennation.
inline constexpr double kLeastPennationCosine = 0.1;
/// Least value of a f_l in the undamped equilibrium.
inline constexpr double kLeastStrength = 0.01;

/// A fiber in series with a tendon, between two points of the skeleton: parameters, laws and derived quantities,
/// immutable. `T` is double, or ceres::Jet for exact derivatives by states, inputs and parameters: lift the parameters
/// with `lifted`, seed them, and build a Musculotendon<Jet>.
///
///   along(l_m) = sqrt(l_m^2 - h^2),  h = l0 sin(alpha0),  cos(alpha) = along / l_m
///   l_t = l_mt - along(l_m),         F_t = F_max f_t((l_t - l_t0) / l_t0),  never negative
///   F_m = F_max (a f_l f_v + f_pe) + B_m v,   B_m = beta F_max / v_max
///
///   mass:         M_m dv/dt = F_t / cos(alpha) - F_m          (equation (5) of the source paper)
///   equilibrium:  F_t = F_m cos(alpha), solved for v = dl_m/dt
///   rigid:        l_t = l_t0, F_t = F_m cos(alpha). A tendon does not push: where B_m v would make
///                 F_m negative, the damper gives way to F_m = 0.
///
/// Below its shortest length (a hundredth of l0, or cos(alpha) = 0.1) a stiff spring holds the
/// fiber, and its line of pull keeps its angle. With zero damping the equilibrium needs an
/// invertible a f_l f_v: the velocity law then continues as its tangents (below -v_max, above 95 %
/// of the plateau) and a f_l is at least `kLeastStrength`. docs/theory/muscle.md derives all this.
template <typename T = double>
class Musculotendon {
 public:
  /// Throws InvalidInput if the parameters make no unit under these laws.
  explicit Musculotendon(const MusculotendonParameters<T>& parameters,
                         const MusculotendonLaws& laws = {},
                         const MillardShape& millard = {});

  [[nodiscard]] const MusculotendonParameters<T>& parameters() const { return p_; }
  [[nodiscard]] const MusculotendonLaws& laws() const { return curves_.laws(); }
  [[nodiscard]] const NormalizedCurves<T>& curves() const { return curves_; }
  [[nodiscard]] const T& height_m() const { return height_; }  ///< h
  [[nodiscard]] const T& shortest_fiber_m() const { return shortest_; }
  [[nodiscard]] const T& damping_nspm() const { return damping_; }  ///< B_m
  [[nodiscard]] bool undamped_equilibrium() const { return undamped_equilibrium_; }

 private:
  MusculotendonParameters<T> p_;
  bool undamped_equilibrium_;
  NormalizedCurves<T> curves_;
  T height_{};
  T shortest_{};
  T damping_{};
};

/// States that the mode integrates: rigid 0, equilibrium 1 (l_m), mass 2 (l_m, then dl_m/dt).
[[nodiscard]] constexpr int state_size(TendonMode mode) {
  return mode == TendonMode::rigid ? 0 : mode == TendonMode::equilibrium ? 1 : 2;
}

/// The drive of a unit: activation 0..1, length [m] and velocity [m/s] of the whole path.
template <typename T = double>
struct MusculotendonInput {
  T activation{};
  T length_m{};
  T velocity_mps{};
};

/// The states; a mode ignores the states that it does not have.
template <typename T = double>
struct MusculotendonState {
  T fiber_length_m{};
  T fiber_velocity_mps{};
};

/// The right-hand side and the force on the skeleton, as an integrator calls them. No allocation.
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

/// Returns F_t of `musculotendon_rate` alone. Unless the tendon is rigid, the fiber's velocity is not solved for.
template <typename T>
[[nodiscard]] T tendon_force_n(const Musculotendon<T>& unit,
                               const MusculotendonInput<T>& input,
                               const MusculotendonState<T>& state);

/// Powers [W], positive where an element gives them: the contractile element in shortening, a spring when it relaxes,
/// the viscous one never.
///   active + passive + viscous + tendon + kinetic = musculotendon = -F_t dl_mt/dt
template <typename T>
struct MusculotendonPower {
  T active{}, passive{}, viscous{}, tendon{}, kinetic{}, musculotendon{};
};

/// Stored energies [J], zero in a slack spring and in a fiber at rest: power = -dE/dt.
template <typename T>
struct MusculotendonEnergy {
  T passive{}, tendon{}, kinetic{};
};

/// Lengths, forces, powers and energies at one instant.
template <typename T = double>
struct MusculotendonOutput {
  T fiber_length_m{}, fiber_velocity_mps{}, fiber_acceleration_mps2{};
  T cos_pennation{};
  T tendon_length_m{}, tendon_velocity_mps{};
  T length_multiplier{}, velocity_multiplier{};              ///< f_l, f_v
  T active_force_n{}, passive_force_n{}, viscous_force_n{};  ///< Along the fiber.
  T fiber_force_n{};                                         ///< Their sum, F_m.
  T tendon_force_n{};                                        ///< F_t
  MusculotendonPower<T> power_w;
  MusculotendonEnergy<T> energy_j;
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

/// Returns a state in which the unit is steady under a constant input: the tendon's length does not change, so v =
/// dl_mt/dt cos(alpha), and F_t = F_m cos(alpha) to round-off. If there are several, the state is a stable one, in
/// which the tendon's pull falls faster with l_m than the fiber's. With a slack tendon the fiber has the length that
/// leaves the tendon just slack. T = Jet: with the derivatives of the solution.
template <typename T>
[[nodiscard]] MusculotendonState<T> equilibrium_state(const Musculotendon<T>& unit, const MusculotendonInput<T>& input);

/// Quantities at whose zeros the right-hand side has a kink or a jump in its derivatives, for the
/// event location of an integrator: [0] tendon strain (slack below 0), [1] v / v_max, [2] 1 + v /
/// v_max, [3] l_m / l0 - 1 (passive onset), [4] l_m over its lower limit, minus 1, [5] v over where
/// an upper tangent begins, or +1. Laws without the kink make the zero harmless.
inline constexpr int kMusculotendonEventCount = 6;
[[nodiscard]] std::array<double, kMusculotendonEventCount> musculotendon_events(
    const Musculotendon<double>& unit,
    const MusculotendonInput<double>& input,
    const MusculotendonState<double>& state);

}  // namespace myoid::muscle

#include "myoid/muscle/musculotendon_inl.h"
