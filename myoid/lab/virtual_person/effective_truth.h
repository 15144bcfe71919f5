#pragma once

#include <vector>

#include "myoid/lab/virtual_person/true_arm.h"
#include "myoid/lab/virtual_person/virtual_arm.h"

namespace myoid::lab {

/// Returns the fitted model's parameters that come closest to a person at level L2: the
/// least-squares fit, all muscles together, of
///
///   r_model(q) a f_l(l_model - l_ts; l_0 (1 + gamma (1 - a))) f_v F_max
///
/// to the sum over a muscle's heads of r(q) F_t minus this sum at a = 0, over elbow angles from 15 to 130 degrees,
/// steady speeds up to 5 rad/s in either direction and activations from 0.1 to 0.9. As in a study, one gamma shifts the
/// optimum of all muscles with activation. The torque of unexcited muscles, from stretched and damped fibers, counts as
/// the joint's (as in passive trials and the joint's viscosity) and not as the muscle's. v_max and l_ts are held at the
/// literature's values. Weak tethers keep the three numbers of f_v near the literature, because these speeds alone do
/// not separate them. A perfect experiment with the fitted model would give this result, with wrong moment arms,
/// stretching tendons and pennation. `misfit`, if not null, receives the root mean square of the rest over that of the
/// torque.
[[nodiscard]] HillSet effective_muscles(const TrueArm& person, const VirtualArm& modelled, PerMuscle* misfit = nullptr);

/// Returns the torque of a muscle's unexcited heads at this angle and speed [N m].
[[nodiscard]] double resting_torque_nm(const TrueArm& person,
                                       std::size_t muscle,
                                       double elbow_flexion_rad,
                                       double elbow_flexion_speed_radps);

/// Returns the torque that a muscle's excitation adds at steady speed, at each angle [N m]. Each head's activation is
/// the muscle's times TrueHead::drive, at most 1.
[[nodiscard]] std::vector<double> active_torque_nm(const TrueArm& person,
                                                   std::size_t muscle,
                                                   double activation,
                                                   const std::vector<double>& elbow_flexion_rad,
                                                   double elbow_flexion_speed_radps);

/// Returns F_max of the heads added up along the tendon [N], the muscle's anatomical strength.
[[nodiscard]] PerMuscle anatomical_strength_n(const TrueArm& person);

}  // namespace myoid::lab
