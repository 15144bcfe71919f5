#pragma once

#include "myoid/virtual_person/true_arm.h"
#include "myoid/virtual_person/virtual_arm.h"

namespace myoid::twin {

/// The fitted model's parameters that come closest to a person at level L2: the least-squares fit,
/// all muscles together, of
///
///   r_model(q) a f_l(l_model - l_ts; l_0 (1 + gamma (1 - a))) f_v F_max
///
/// to the sum over a muscle's heads of r(q) F_t less what they make with a = 0, over elbow angles
/// from 15 to 130 degrees, steady speeds up to 5 rad/s either way and activations from 0.1 to 0.9.
/// As in a study, one gamma shifts the optimum of all muscles with activation, and what a muscle
/// does while nothing excites it, its stretched and damped fibers, is the joint's (as passive
/// trials and the joint's viscosity have it) and not the muscle's. v_max and l_ts are the
/// literature's, held, and the three numbers of f_v are tethered loosely to the literature, since
/// these speeds alone do not tell them apart. It is what a perfect experiment with the fitted model
/// would find: wrong moment arms, stretching tendons and pennation are all in it. `misfit`, if not
/// null, receives the root mean square of the rest over that of the torque.
[[nodiscard]] HillSet effective_muscles(const TrueArm& person,
                                        const VirtualArm& modelled,
                                        PerMuscle* misfit = nullptr);

/// Returns the torque of a muscle's unexcited heads at this angle and speed [N m].
[[nodiscard]] double resting_torque_nm(const TrueArm& person,
                                       std::size_t muscle,
                                       double elbow_flexion_rad,
                                       double elbow_flexion_speed_radps);

/// F_max of the heads added up along the tendon [N]: what anatomy would call the muscle's strength.
[[nodiscard]] PerMuscle anatomical_strength_n(const TrueArm& person);

}  // namespace myoid::twin
