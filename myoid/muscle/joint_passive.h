#pragma once

#include <cmath>

#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// A relaxed joint: a spring, a dashpot, and ligaments as exponential stops at both ends of the range.
///
///   T(q, qdot) = -k (q - q0) - b qdot + t_low exp(-(q - q_low) / w_low)
///                - t_high exp((q - q_high) / w_high)
///
/// The double exponential of the literature with rates 1/w. All zero: a free joint.
template <typename T = double>
struct JointPassive {
  T stiffness_nm_per_rad{};         ///< k
  T neutral_rad{};                  ///< q0
  T viscosity_nms_per_rad{};        ///< b; the source paper's B_l
  T lower_stop_torque_nm{};         ///< t_low: the push of the stop at q_low
  T lower_stop_rad{};               ///< q_low
  T lower_stop_width_rad{T(0.05)};  ///< w_low: the angle over which the push grows e-fold
  T upper_stop_torque_nm{};         ///< t_high
  T upper_stop_rad{};               ///< q_high
  T upper_stop_width_rad{T(0.05)};  ///< w_high
};

/// Throws InvalidInput, naming the field, unless all are finite, widths positive, and stiffness,
/// viscosity and stop torques not negative.
void validate(const JointPassive<double>& joint);

/// Returns a grown man's elbow, flexion angle from full extension: 1 N m/rad about 80 degrees, 0.2
/// N m s/rad, and stops of 1 N m at 10 and 140 degrees that grow e-fold every 3 degrees. Orders of
/// magnitude from memory of the literature, not measurements: measure a relaxed joint and fit.
[[nodiscard]] JointPassive<double> elbow_passive();

/// The torque and its shares.
template <typename T = double>
struct JointPassiveOutput {
  T torque_nm{};                      ///< Elastic and viscous.
  T elastic_torque_nm{};              ///< -dE/dq
  T viscous_torque_nm{};              ///< -b qdot
  T stored_energy_j{};                ///< E of spring and stops.
  T viscous_power_w{};                ///< Given by the dashpot, -b qdot^2: never positive.
  double stiffness_nm_per_rad = 0.0;  ///< -dT/dq >= 0
};

template <typename T>
[[nodiscard]] JointPassiveOutput<T> joint_passive(const JointPassive<T>& j,
                                                  const T& angle_rad,
                                                  const T& velocity_radps) {
  using std::exp;
  const T off = angle_rad - j.neutral_rad;
  const T low = j.lower_stop_torque_nm * exp((j.lower_stop_rad - angle_rad) / j.lower_stop_width_rad);
  const T high = j.upper_stop_torque_nm * exp((angle_rad - j.upper_stop_rad) / j.upper_stop_width_rad);
  JointPassiveOutput<T> o;
  o.elastic_torque_nm = low - high - j.stiffness_nm_per_rad * off;
  o.viscous_torque_nm = -j.viscosity_nms_per_rad * velocity_radps;
  o.torque_nm = o.elastic_torque_nm + o.viscous_torque_nm;
  o.stored_energy_j =
      T(0.5) * j.stiffness_nm_per_rad * off * off + low * j.lower_stop_width_rad + high * j.upper_stop_width_rad;
  o.viscous_power_w = o.viscous_torque_nm * velocity_radps;
  o.stiffness_nm_per_rad =
      value_of(j.stiffness_nm_per_rad + low / j.lower_stop_width_rad + high / j.upper_stop_width_rad);
  return o;
}

}  // namespace myoid::muscle
