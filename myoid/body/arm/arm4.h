#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/arm/planar_elbow.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::body {

struct Arm4Options {
  ArmOptions person;
  /// Default posture: the upper arm raised forward and turned, so that the axis of the elbow is
  /// vertical. (Raised to the side, two of the shoulder's three axes would coincide.)
  bool horizontal = false;
  /// For recordings whose landmarks all move with the forearm: the trunk gets the coordinates
  /// base_heading, base_tx, base_ty and base_tz, and between the elbow and the forearm come
  /// elbow_carrying and forearm_rotation; all of them locked by default. The muscles insert above
  /// these (body "ulna"), so that their lengths depend on elbow_flexion only.
  bool forearm_rotations = false;
  /// The upper arm hangs at rest: elbow_flexion is the one coordinate.
  bool elbow_only = false;
};

/// Returns the built-in right arm as an OpenSim model file (version 40000): bodies trunk, upper_arm and forearm_hand
/// (frame at the elbow, long axis -y, x forward when the arm hangs, z to the right); coordinates shoulder_flexion (z),
/// shoulder_adduction (x), shoulder_rotation (y), elbow_flexion; muscles BIC, BRA, BRD, TRI (Thelen2003Muscle) with the
/// lengths of `planar_elbow` and the numbers of `arm4_muscles`; markers. The numbers read back to the bit.
[[nodiscard]] std::string arm4_osim(const Arm4Options& options = {});

/// A muscle of the built-in arm in its model file.
struct ArmMuscle {
  PlanarMuscle path;
  muscle::HillParameters<double> hill;
  double pennation_at_optimal_rad = 0.0;
};

/// Returns the model file of the built-in skeleton with these muscles; see `arm4_osim`.
[[nodiscard]] std::string arm_osim(const Arm4Options& options,
                                   std::string_view name,
                                   const std::vector<ArmMuscle>& muscles);

/// Elbow flexion at which the fibers of BIC, BRA, BRD and TRI are optimal.
inline constexpr std::array<double, 4> kArmOptimalAt_rad = {85.0 * kDegree, 75.0 * kDegree, 95.0 * kDegree,
                                                            60.0 * kDegree};

/// Returns the literature's parameters for BIC, BRA, BRD and TRI (l_sh = 0.45 l0, V_sh 0.28, V_ml
/// 1.4), with tendon lengths that make the fibers optimal at 85, 75, 95 and 60 degrees of elbow
/// flexion: the published slack lengths belong to other paths.
[[nodiscard]] std::array<muscle::HillParameters<double>, 4> arm4_muscles(const ArmOptions& options = {});

/// Returns the shoulder coordinates (flexion, adduction, rotation) [rad] of a plane of movement.
[[nodiscard]] Vec3 arm4_shoulder_rad(bool horizontal);

/// Returns the point at which a held mass acts, in the frame of forearm_hand [m].
[[nodiscard]] Vec3 arm4_held_at_m(const ArmOptions& options = {});

}  // namespace myoid::body
