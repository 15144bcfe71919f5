#pragma once

#include <cmath>
#include <vector>

#include "myoid/muscle/musculotendon.h"
#include "myoid/simulation/arm.h"

namespace myoid::simulation {

/// Length of a path at an angle, and its moment arm.
template <typename T>
struct HingeTravel {
  T length_m{};
  T moment_arm_m{};  ///< r = -dl/dq
};

template <typename T>
[[nodiscard]] HingeTravel<T> travel(const HingePath<T>& path, const T& angle_rad) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  HingeTravel<T> result{path.constant_m + path.pulley_m * angle_rad, -path.pulley_m};
  if (muscle::value_of(path.above_m) == 0.0) return result;
  const T psi = path.straight_rad - angle_rad;
  const T product = path.above_m * path.below_m;
  const T across = sqrt(path.above_m * path.above_m + path.below_m * path.below_m - 2.0 * product * cos(psi));
  result.length_m += across;
  result.moment_arm_m += product * sin(psi) / across;
  return result;
}

/// The arm's equations of motion, ready to be evaluated: immutable. States: q, qdot, then for each
/// muscle those of its tendon mode (none; l_m; l_m and dl_m/dt).
template <typename T = double>
class ArmDynamics {
 public:
  explicit ArmDynamics(Arm<T> arm) : arm_(std::move(arm)) {
    offsets_.push_back(2);
    for (const ArmMuscle<T>& m : arm_.muscles) {
      units_.emplace_back(m.parameters, m.laws);
      offsets_.push_back(offsets_.back() + static_cast<std::size_t>(muscle::state_size(m.laws.mode)));
    }
    inertia_ = arm_.inertia_kgm2 + arm_.held_mass_kg * arm_.held_at_m * arm_.held_at_m;
    static_moment_ = arm_.static_moment_kgm + arm_.held_mass_kg * arm_.held_at_m;
  }

  [[nodiscard]] const Arm<T>& arm() const { return arm_; }
  [[nodiscard]] std::size_t muscle_count() const { return units_.size(); }
  [[nodiscard]] std::size_t state_count() const { return offsets_.back(); }
  [[nodiscard]] std::size_t offset(std::size_t muscle) const { return offsets_[muscle]; }
  [[nodiscard]] const muscle::Musculotendon<T>& unit(std::size_t i) const { return units_[i]; }
  [[nodiscard]] const T& inertia_kgm2() const { return inertia_; }  ///< With the held mass.

  [[nodiscard]] muscle::MusculotendonState<T> fiber(std::size_t i, const T* y) const {
    const std::size_t count = offsets_[i + 1] - offsets_[i];
    const T* s = y + offsets_[i];
    return {count > 0 ? s[0] : T(0.0), count > 1 ? s[1] : T(0.0)};
  }
  [[nodiscard]] muscle::MusculotendonInput<T> input(std::size_t i,
                                                    const T& activation,
                                                    const T* y,
                                                    T& moment_arm_m) const {
    const HingeTravel<T> path = travel(arm_.muscles[i].path, y[0]);
    moment_arm_m = path.moment_arm_m;
    return {activation, path.length_m, -path.moment_arm_m * y[1]};
  }

  [[nodiscard]] T gravity_torque_nm(const T& q) const {
    using std::sin;
    return -static_moment_ * arm_.gravity_mps2 * sin(q);
  }
  /// Returns the energy in gravity, zero if the forearm hangs.
  [[nodiscard]] T gravity_energy_j(const T& q) const {
    using std::cos;
    return static_moment_ * arm_.gravity_mps2 * (1.0 - cos(q));
  }

  /// Computes dy/dt. `activation` has one value per muscle.
  void rate(const T* activation, const T& external_nm, const T* y, T* ydot) const {
    T torque = external_nm + gravity_torque_nm(y[0]);
    torque += muscle::joint_passive(arm_.joint, y[0], y[1]).torque_nm;
    for (std::size_t i = 0; i < units_.size(); ++i) {
      T arm_m{};
      const auto in = input(i, activation[i], y, arm_m);
      const auto r = muscle::musculotendon_rate(units_[i], in, fiber(i, y));
      torque += arm_m * r.tendon_force_n;
      const std::size_t o = offsets_[i];
      if (offsets_[i + 1] > o) ydot[o] = r.fiber_length_rate_mps;
      if (offsets_[i + 1] > o + 1) ydot[o + 1] = r.fiber_velocity_rate_mps2;
    }
    ydot[0] = y[1];
    ydot[1] = torque / inertia_;
  }

 private:
  Arm<T> arm_;
  std::vector<muscle::Musculotendon<T>> units_;
  std::vector<std::size_t> offsets_;
  T inertia_{};
  T static_moment_{};
};

}  // namespace myoid::simulation
