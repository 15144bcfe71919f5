#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/core/time_series.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"

namespace myoid::kinematics {

/// A desired value of a coordinate. The task adds W (q - q*)^2 / 2 to the objective.
struct CoordinateTask {
  std::string coordinate;
  double value = 0.0;        ///< q* [rad or m]
  double weight = 1.0;       ///< W
  Eigen::VectorXd values{};  ///< q* frame by frame; empty: `value` in all.
};

struct IkOptions {
  std::map<std::string, double> marker_weights{};  ///< By name; other markers have weight 1.
  std::vector<CoordinateTask> tasks{};
  /// True: markers without an entry in `marker_weights` do not count, as with OpenSim's marker tasks.
  bool only_named_markers = false;
  /// Above 0: a barrier of this weight, added to J (range_barrier.h) [m^2], keeps clamped coordinates inside their
  /// ranges. A coordinate that no marker determines goes to the middle of its range.
  double range_barrier = 0.0;
  int max_iterations = 200;
  Progress progress{};
};

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
  std::vector<std::string> undetermined;
  std::vector<std::string> notes;  ///< Markers without counterpart, coordinates at ends of their ranges.
};

/// Fits the pose of the model to the measured markers, frame by frame from the previous solution:
///
///   J(q) = sum w_i |x_i - m_i(q)|^2 / (2 sum w_i) + sum W_j (q_j - q_j*)^2 / 2
///
/// over the markers seen in the frame. Newton's method with the damping of Levenberg and Marquardt uses analytic
/// Jacobians and the second derivatives of the chains of rotations. The first frame and every frame in which the method
/// stalls or J jumps are solved again from other postures (the default posture, also turned about the vertical); a
/// solution with J of half or less wins. Locked coordinates stay at their default value, prescribed coordinates follow
/// their function, clamped coordinates stay within their range. Couplers are eliminated; every step meets the other
/// constraints (model/constraints.h). Throws InvalidInput if no marker of the file is in the model, or a weight is
/// negative or of an unknown marker; ModelError if the model cannot be posed.
[[nodiscard]] IkResult inverse_kinematics(const model::BodyModel& model,
                                          const recording::MarkerSeries& markers,
                                          const IkOptions& options = {});

}  // namespace myoid::kinematics
