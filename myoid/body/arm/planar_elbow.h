#pragma once

#include <array>
#include <string_view>

#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// Whose arm it is.
struct ArmOptions {
  double mass_kg = 73.0;  ///< Mass of the whole body.
  bool female = false;    ///< Which fractions of body mass and segment length apply.
  double upper_arm_length_m = 0.30;
  double forearm_length_m = 0.2689;  ///< Elbow to wrist.
};

/// Mass, center and inertia of a segment whose long axis is -y from its proximal joint.
struct SegmentInertia {
  double mass_kg = 0.0;
  double center_m = 0.0;          ///< Distance of the mass center from the proximal joint.
  Vec3 I_cm_kgm2 = Vec3::Zero();  ///< About x (sagittal), y (long) and z (transverse) axes through it.
};

/// Returns the upper arm, or forearm with hand as one body, after de Leva (1996). Throws
/// InvalidInput unless mass and lengths are positive and finite.
[[nodiscard]] SegmentInertia upper_arm(const ArmOptions& options);
[[nodiscard]] SegmentInertia forearm_with_hand(const ArmOptions& options);

/// Returns the distance from the elbow to the held object: the center of the hand [m].
[[nodiscard]] double held_at_m(const ArmOptions& options);

/// A muscle across a hinge in its plane. Flexors follow the law of cosines between their
/// attachments, the triceps a pulley:
///
///   l(q) = constant + sqrt(L1^2 + L2^2 - 2 L1 L2 cos(psi0 - q)) + pulley q - taper (q - q_t)^2 /
///   2, r = -dl/dq
struct PlanarMuscle {
  std::string_view name;
  double constant_m = 0.0;       ///< The part of the path that does not cross the elbow.
  double above_m = 0.0;          ///< L1: elbow to the attachment on the upper arm; 0: pulley only.
  double below_m = 0.0;          ///< L2: elbow to the attachment on the forearm.
  double straight_rad = 0.0;     ///< psi0: the angle between the two in full extension.
  double pulley_m = 0.0;         ///< Radius about which an extensor turns.
  double taper_mprad = 0.0;      ///< Moment arm that each radian from q_t adds.
  double taper_about_rad = 0.0;  ///< q_t
};

/// Muscle with tendon: length, and the derivatives by the angle.
struct MuscleTravel {
  double length_m = 0.0;
  double moment_arm_m = 0.0;            ///< r = -dl/dq [m/rad]: flexors positive.
  double moment_arm_slope_mprad = 0.0;  ///< dr/dq
};
[[nodiscard]] MuscleTravel travel(const PlanarMuscle& muscle, double elbow_flexion_rad);

/// Forearm and hand on the hinge of the elbow.
struct HingedForearm {
  double inertia_kgm2 = 0.0;       ///< Moment of inertia about the elbow.
  double static_moment_kgm = 0.0;  ///< Mass times distance of its center.
  double held_at_m = 0.0;          ///< Distance of a held object from the elbow.
};

/// The closed-form arm: an upper arm at rest, a forearm with hand on a hinge, four muscles.
struct PlanarElbow : HingedForearm {
  std::array<PlanarMuscle, 4> muscles;  ///< BIC, BRA, BRD, TRI.
};

/// Returns the built-in arm. Attachments of the flexors are least-squares fits of the law above to
/// the moment arms of Pigeon, Yahia & Feldman (1996) between 10 and 130 degrees (rms 2-3 mm), and
/// so is the triceps' pulley of 21 mm. They do not scale with the segments.
[[nodiscard]] PlanarElbow planar_elbow(const ArmOptions& options = {});

/// Returns the torque about the elbow that a movement requires [N m], flexion positive, with the
/// upper arm at rest and `gravity_mps2` the part of gravity in the plane of movement, along the
/// upper arm towards the elbow (9.81 when it hangs, 0 when the axis of the elbow is vertical):
///
///   T = (J + m d^2) qddot + (S + m d) g sin q
[[nodiscard]] double required_torque_nm(const HingedForearm& forearm,
                                        double elbow_flexion_rad,
                                        double acceleration_radps2,
                                        double gravity_mps2,
                                        double held_mass_kg = 0.0);

}  // namespace myoid::body
