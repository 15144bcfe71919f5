#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/kinematics/ik_options.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::body {

enum class FrameStatus {
  converged,
  not_converged,
  no_markers,  ///< The frame shows no marker of the model and keeps the pose of the frame before.
};

struct IkResult {
  TimeSeries q;                     ///< All coordinates, in the model's order [rad | m].
  std::vector<FrameStatus> status;  ///< Per frame.
  /// total_squared_error [m^2, dimensionless channel], marker_error_RMS, marker_error_max [m], then
  /// the distance of each marker [m]; NaN for a missing marker.
  TimeSeries errors;
  std::vector<double> objective;  ///< J, per frame.
  /// Places of the model markers that count: "<marker>_tx", "_ty", "_tz" [m].
  TimeSeries marker_locations;
  int frames_not_converged = 0;
  int frames_without_markers = 0;
  /// Free coordinates that the markers leave open in the frames seen.
  std::vector<std::string> open_coordinates;
  std::vector<Remark> notes;  ///< Markers without counterpart.
};

/// Fits the pose of the model to the measured markers, frame by frame from the previous solution:
///
///   J(q) = sum w_i |x_i - m_i(q)|^2 / (2 sum w_i) + sum W_j (q_j - q_j*)^2 / 2
///
/// over the markers seen in the frame. Newton's method with the damping of Levenberg and Marquardt uses analytic
/// Jacobians and the second derivatives of the chains of rotations. The first frame is solved from several postures
/// (the default posture, also turned about the vertical), a frame in which the method stalls or J jumps as well. Each
/// limb is also searched from bent postures, judged by its own markers, and a better minimum is followed through the
/// frames (pose_sequence.h): mirrored postures of a limb do not stay. Locked coordinates stay at their default value,
/// prescribed coordinates follow their function, clamped coordinates stay within their range. Couplers are eliminated;
/// every step meets the other constraints (body/model/constraints.h). Throws InvalidInput if no marker of the file is
/// in the model, or a weight is negative or of an unknown marker; ModelError if the model cannot be posed.
[[nodiscard]] IkResult inverse_kinematics(const body::BodyModel& model,
                                          const MarkerSeries& markers,
                                          const IkOptions& options = {});

/// A free coordinate that lies at one end of its range.
struct CoordinateAtEnd {
  std::string coordinate;
  double end = 0.0;    ///< [rad | m]
  double share = 0.0;  ///< Of the frames.
};

/// Returns the clamped coordinates that lie at one end of their range in a quarter of the frames of a motion, or more,
/// and rotations of a body on ground that do so in two frames. There the markers pull further, or the search has met a
/// stop.
[[nodiscard]] std::vector<CoordinateAtEnd> coordinates_at_ends(const body::BodyModel& model, const TimeSeries& q);

/// Returns the same as one warning; none if there is no such coordinate.
[[nodiscard]] std::vector<Remark> remarks_on_ends(const body::BodyModel& model, const TimeSeries& q);

}  // namespace myoid::body
