#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/c3d/c3d_file.h"
#include "myoid/recording/force_plate.h"
#include "myoid/recording/recorded_trial.h"

namespace myoid::recording {

/// The upward axis of a laboratory, and the reasons.
struct LaboratoryUp {
  std::optional<Vec3> up_L;  ///< Along an axis, in either direction; empty if unknown.
  std::string because;       ///< "POINT:Y_SCREEN says that z points up; plates 1, 2
                             ///< face it and bear 700 N".
};

/// Returns the name of the axis along which a unit vector lies: "z", "-y".
[[nodiscard]] std::string axis_name(const Vec3& axis);
/// Returns the unit vector of "z", "+Z", "-y", "Z-"; empty for other words.
[[nodiscard]] std::optional<Vec3> axis_vector(std::string_view name);

/// Returns the rotation that turns `up_L`, a signed axis, to y: `rotation_to_y_up` of x, y, z.
[[nodiscard]] Mat3 rotation_to_y_up(const Vec3& up_L);

/// Returns the axis that points up on the screen: POINT:Y_SCREEN, or the second axis of
/// POINT:SCREEN ("+X+Z"). Empty if neither is an axis or X_SCREEN is the same one. Its sign is no
/// evidence alone: Qualisys writes "-Z" where z points up.
[[nodiscard]] std::optional<Vec3> screen_up(const C3dFile& file);

/// The load of a plate by its channels alone. The size of the normal force weights the means, so
/// that neither an offset nor a spike decides.
struct PlateLoad {
  Vec3 normal_L = Vec3::UnitZ();  ///< z of the plate.
  Vec3 push_n = Vec3::Zero();     ///< Weighted mean force, with the sign of the channels.
  double along_n = 0.0;           ///< Part of `push_n` along the normal.
  double rms_n = 0.0;             ///< RMS of the normal force over all samples; 0 below the threshold.
  double largest_n = 0.0;         ///< Largest size of the whole force.
  /// The normal force [N] if the force is the same in every sample: the plate is unplugged or was
  /// never zeroed. The other sizes are then 0.
  std::optional<double> constant_n;
  [[nodiscard]] bool loaded() const { return rms_n > 0.0; }
};
[[nodiscard]] PlateLoad plate_load(const Recording& recording, const PlateSetup& setup, double least_force_n);

/// Returns +1 or -1 if at least eight markers are clearly on one side of a point along a direction:
/// 95 % of their positions, with a median distance of 0.3 m; else 0.
[[nodiscard]] double markers_side(const MarkerSeries& markers, const Vec3& from_m, const Vec3& along);

/// Returns true for a plate within 60 degrees of horizontal, on which a person stands.
[[nodiscard]] bool is_floor(const PlateLoad& load, const Vec3& up_L);

/// Finds the upward axis from the file alone; empty without a screen and plates.
///
/// The axis is that of POINT:Y_SCREEN, else that which the loaded plates face. Throws InvalidInput where the screen,
/// the corners and the load name different axes, naming two of them. Of the two directions along the axis, the one with
/// fewer faults is up. Faults are: the screen has the other sign (2); the axis points down (3.5); the plates' corners
/// run the other way round than in the C3D guide, their loads pull down, their ORIGIN is above the surface (each the
/// share of the plates, 0 to 1); eight or more markers lie below the floor's plates (10), three to seven (2); without
/// plates, below the origin of the laboratory (2 and 1).
[[nodiscard]] LaboratoryUp laboratory_up(const Recording& recording, const std::vector<PlateLoad>& loads);

}  // namespace myoid::recording
