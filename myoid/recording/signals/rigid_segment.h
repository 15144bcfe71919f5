#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {

/// Markers on one segment, by their column in a MarkerSeries.
struct RigidSegment {
  std::string name;
  std::vector<Eigen::Index> markers;
};

/// The rotation and translation that bring points of a segment nearest to their measured positions.
struct RigidFit {
  Mat3 R = Mat3::Identity();
  Vec3 p_m = Vec3::Zero();
  double rms_m = 0.0;  ///< RMS of the residuals.

  [[nodiscard]] Vec3 apply(const Vec3& local_m) const { return R * local_m + p_m; }
};

/// Minimizes the sum of |R a_i + p - b_i|^2 with det R = +1, by the singular values of the
/// covariance (Kabsch 1976). Columns are points. Throws InvalidInput for fewer than three; if all
/// lie on a line, the turn about that line is arbitrary.
[[nodiscard]] RigidFit fit_rigid(const Eigen::Matrix3Xd& local_m, const Eigen::Matrix3Xd& seen_m);

/// Returns the places of the markers on their segment: the mean over all frames that show every one of them, each laid
/// on the first by `fit_rigid`. Has no columns without such a frame or with fewer than three markers.
[[nodiscard]] Eigen::Matrix3Xd mean_shape(const MarkerSeries& markers, const RigidSegment& segment);

/// Checks that distances within a segment stay. Reports the markers that depart from their median
/// distance to others of the segment for three frames or more, worst first, each once.
[[nodiscard]] std::vector<Remark> check_rigid_segments(const MarkerSeries& markers,
                                                       const std::vector<RigidSegment>& segments);

}  // namespace myoid::recording
