#pragma once

#include <array>
#include <string_view>

#include "myoid/body/arm/planar_elbow.h"
#include "myoid/ground/math/random.h"
#include "myoid/lab/virtual_person/control.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/muscle/activation.h"
#include "myoid/muscle/fatigue.h"
#include "myoid/muscle/joint_passive.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::lab {

inline constexpr std::size_t kHeadCount = 7;

/// A number per head, in the order of body::kArm7Heads.
using PerHead = std::array<double, kHeadCount>;

/// One head of a person at level L2.
struct TrueHead {
  std::string_view name;
  std::size_t muscle = 0;  ///< Index into kArmMuscles: the muscle that it is a part of.
  body::PlanarMuscle path;
  muscle::MusculotendonParameters<double> parameters;
  double drive = 1.0;            ///< Its excitation over its muscle's.
  double electrode_share = 1.0;  ///< Share of the power that its muscle's electrode picks up.
};

/// The arm of a person at level L2, with all its departures from the fitted arm.
struct TrueArm : body::HingedForearm {
  std::array<TrueHead, kHeadCount> heads;
  muscle::MusculotendonLaws laws;  ///< Elastic tendon; De Groote's or Millard's curves.
  muscle::MillardShape millard;
  muscle::ActivationDynamics<double> activation;  ///< Equation (1) of the source paper.
  double delay_s = 0.0;                           ///< From the electrode's signal to the muscle's excitation.
  muscle::JointPassive<double> joint;
};

/// Draws an arm. Standard deviations, times `spec.spread`: ln F_max 0.2 for the person, 0.15 per muscle and 0.05 per
/// head; l_0 10 % per muscle and 3 % per head; place of the fibers' optimum in the range, 3 % of l_0 + l_ts per muscle;
/// ln v_max 0.2; moment arms `spec.moment_arm_sd` per muscle, and `spec.moment_arm_slope_sd` per radian; inertia and
/// weight `spec.inertia_sd`; place of the held mass in the hand, 2 %. Uniform: tendon strain at F_max
/// `spec.tendon_strain`, shift of the optimum with activation 0.10 to 0.20, passive strain at F_max 0.8 to 1.2, pure
/// delay 0 to 20 ms, spring and dashpot of the joint up to half of muscle::elbow_passive (its stops are whole). ln
/// tau_ne 0.2, ln tau_ac and ln tau_deac 0.25 about 40, 15 and 50 ms. `spec.offset` shifts F_max, l_0 and v_max by this
/// number of standard deviations. Curves are those of `spec.curves`, or one of the two sets by chance; Millard's
/// eccentric maximum is uniform in 1.3 to 1.5.
[[nodiscard]] TrueArm draw_true_arm(const TruthSpec& spec, const VirtualSubject& subject, math::Random& random);

/// Returns the torque about the elbow that the motion requires of muscles, joint and dynamometer together [N m].
[[nodiscard]] double required_torque_nm(const body::HingedForearm& forearm,
                                        double elbow_flexion_rad,
                                        double acceleration_radps2,
                                        Plane plane,
                                        double held_mass_kg);

}  // namespace myoid::lab
