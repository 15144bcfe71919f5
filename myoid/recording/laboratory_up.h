#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/c3d/c3d_file.h"
#include "myoid/core/geometry.h"
#include "myoid/files/marker_series.h"
#include "myoid/recording/force_plate.h"
#include "myoid/recording/recording.h"

namespace myoid::recording {

/// Which way is up in a laboratory, and the reasons.
struct LaboratoryUp {
  std::optional<Vec3> up_L;  ///< Along an axis, either way; empty where nothing tells.
  std::string because;       ///< "POINT:Y_SCREEN says that z points up; plates 1, 2
                             ///< face it and bear 700 N".
};

/// "z", "-y": the name of the axis along which a unit vector lies.
[[nodiscard]] std::string axis_name(const Vec3& axis);
/// The unit vector of "z", "+Z", "-y", "Z-"; empty for other words.
[[nodiscard]] std::optional<Vec3> axis_vector(std::string_view name);

/// The rotation that brings `up_L`, along an axis and either way, to y: `rotation_to_y_up` of x, y,
/// z.
[[nodiscard]] Mat3 rotation_to_y_up(const Vec3& up_L);

/// The axis that points up on the screen: POINT:Y_SCREEN, or the second one of POINT:SCREEN
/// ("+X+Z"). Empty where neither is an axis, or where X_SCREEN is the same one.
[[nodiscard]] std::optional<Vec3> screen_up(const C3dFile& file);

/// What the channels of a plate tell before anything is known of the laboratory. Weighted means
/// have the size of the normal force as weight, so that neither an offset nor a spike decides.
struct PlateLoad {
  Vec3 normal_L = Vec3::UnitZ();  ///< z of the plate.
  Vec3 push_n = Vec3::Zero();     ///< Weighted mean force, with the sign of the channels.
  double along_n = 0.0;           ///< Its part along the normal.
  double rms_n = 0.0;             ///< Of the normal force, over all samples; 0 below the threshold.
  double largest_n = 0.0;         ///< Of the force as a whole.
  /// The normal force [N] where the force is the same in every sample: unplugged, or never set to
  /// zero. Such a plate tells nothing, and the other sizes are 0.
  std::optional<double> constant_n;
  [[nodiscard]] bool loaded() const { return rms_n > 0.0; }
};
[[nodiscard]] PlateLoad plate_load(const Recording& recording,
                                   const PlateSetup& setup,
                                   double least_force_n);

/// +1 or -1 where eight markers or more are clearly on one side of a point along a direction: 95 %
/// of their positions, the median 0.3 m away; else 0.
[[nodiscard]] double markers_side(const MarkerSeries& markers,
                                  const Vec3& from_m,
                                  const Vec3& along);

/// A plate within 60 degrees of horizontal is a floor, on which a person stands.
[[nodiscard]] bool is_floor(const PlateLoad& load, const Vec3& up_L);

/// What the file says by itself: POINT:Y_SCREEN, the normals of the plates' corners, weighted with
/// the load that they bear along them, the direction of that load, and the side of the floor's
/// plates on which the markers are. Throws InvalidInput where two of them contradict each other,
/// naming both.
[[nodiscard]] LaboratoryUp laboratory_up(const Recording& recording,
                                         const std::vector<PlateLoad>& loads);

}  // namespace myoid::recording
