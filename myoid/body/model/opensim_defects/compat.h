#pragma once

#include <string_view>

#include "myoid/ground/core/choice.h"

namespace myoid::body {

/// Departures of OpenSim 4.5.2 from the geometry of a model, one switch each. With none set
/// (`exact`, the default) lengths are continuous wherever the geometry is, and moment arms are
/// -dl/dq. The switches from `stale_wrap_points` to `approximate_torus` act only if `opensim_paths` is set.
struct Compat {
  /// Paths by OpenSim's constructions: tangent points on a cylinder by one slide along its
  /// generators (for several objects by at most 100 slides to 0.1 degree), an ellipsoid's arc as a
  /// polyline of 1 mm chords, several objects in turn until the length changes by less than 0.5 mm;
  /// moment arms from the forces of unit tension, speeds from the points' velocities.
  bool opensim_paths = false;
  /// With several wrap objects, the straight pieces end at the wrap points first computed for this
  /// posture; arcs belong to the points computed last.
  bool stale_wrap_points = false;
  /// A cylinder's long way round is 2 pi - theta also where theta is negative.
  bool long_turn_of_negative_angle = false;
  /// The far side of a sphere has a negative arc, and a quadrant's decision takes 1 m for the length of the segment.
  bool negative_sphere_arc = false;
  /// The point of a torus nearest to a line comes from a residual that is too large by a factor of
  /// 2.
  bool approximate_torus = false;
  /// An ellipsoid's quadrant with method midpoint or axial mirrors without returning to the surface.
  bool mirrored_without_fan = false;
  /// A moving path point beside a point of the same body does not count in moment arms.
  bool unseen_moving_points = false;
  /// Offsets of joints and inertias of documents before 30500 rounded to six digits.
  bool six_digit_offsets = false;
  /// Accelerations of a CustomJoint: only the first coordinate carries its second axis, and all but
  /// the third coordinate carry its third axis, whichever axes these coordinates turn. Differs if
  /// axes share a coordinate, in inverse dynamics and static optimization.
  bool axes_carried_by_coordinates = false;
  /// Ball-, Free-, Ellipsoid- and ScapulothoracicJoints move by angular velocities, and the tools
  /// set these to the rates of the coordinates (body/kinematics/angular_speeds.h).
  bool rates_for_angular_velocities = false;
  /// A muscle without <default_fiber_length> has 0.1 m, else its optimal fiber length.
  bool class_fiber_length = false;
  /// Static optimization: Millard's cos(pennation) at the normalized fiber length.
  bool normalized_pennation = false;
  /// Scale: the static pose is that of an interior-point search that stops while its barrier holds
  /// clamped coordinates off the ends of their ranges.
  bool static_pose_inside_ranges = false;

  [[nodiscard]] bool operator==(const Compat&) const = default;
};

/// OpenSim 4.5.2 with all of its defects.
inline constexpr Compat kOpenSim452{.opensim_paths = true,
                                    .stale_wrap_points = true,
                                    .long_turn_of_negative_angle = true,
                                    .negative_sphere_arc = true,
                                    .approximate_torus = true,
                                    .mirrored_without_fan = true,
                                    .unseen_moving_points = true,
                                    .six_digit_offsets = true,
                                    .axes_carried_by_coordinates = true,
                                    .rates_for_angular_velocities = true,
                                    .class_fiber_length = true,
                                    .normalized_pennation = true,
                                    .static_pose_inside_ranges = true};

/// The words for these switches: none or all.
enum class Compatibility { exact, opensim };
inline constexpr std::string_view kCompatibilityNames[] = {"exact", "opensim"};
constexpr ChoiceNames choice_names(Compatibility) { return kCompatibilityNames; }
[[nodiscard]] constexpr Compat compat_of(Compatibility word) {
  return word == Compatibility::exact ? Compat{} : kOpenSim452;
}
/// "exact" or "opensim".
[[nodiscard]] std::string_view name_of(const Compat& compat);

}  // namespace myoid::body
