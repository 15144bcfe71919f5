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

/// A wish for a coordinate's value: adds W (q - q*)^2 / 2 to the objective.
struct CoordinateTask {
  std::string coordinate;
  double value = 0.0;        ///< q* [rad or m]
  double weight = 1.0;       ///< W
  Eigen::VectorXd values{};  ///< q* frame by frame; empty: `value` in all.
};

struct IkOptions {
  std::map<std::string, double> marker_weights{};  ///< By name; markers that are not named weigh 1.
  std::vector<CoordinateTask> tasks{};
  /// Markers that are not named in `marker_weights` do not count, as with OpenSim's marker tasks.
  bool only_named_markers = false;
  /// Above 0: clamped coordinates are kept inside their ranges by a barrier of this weight added
  /// to J (range_barrier.h) [m^2]; one that the markers do not determine comes to the middle.
  double range_barrier = 0.0;
  int max_iterations = 200;
  Progress progress{};
};

enum class FrameStatus {
  converged,
  not_converged,
  no_markers,  ///< No marker of the model was seen: the pose of the frame before is kept.
};

struct IkResult {
  TimeSeries q;                     ///< All coordinates, in the model's order [rad | m].
  std::vector<FrameStatus> status;  ///< Per frame.
  TimeSeries errors;  ///< total_squared_error [m^2, dimensionless channel], marker_error_RMS,
                      ///< marker_error_max [m], then the distance of each marker [m]; NaN where it
                      ///< was missing.
  std::vector<double> objective;  ///< J, per frame.
  /// Where the model's markers lie: "<marker>_tx", "_ty", "_tz" [m], of those that count.
  TimeSeries marker_locations;
  int frames_not_converged = 0;
  int frames_without_markers = 0;
  std::vector<std::string>
      undetermined;  ///< Free coordinates that the markers leave open in the frames seen.
  std::vector<std::string> notes;  ///< Markers without counterpart.
};

/// Pose of the model that fits the measured markers best, frame by frame from the solution before:
///
///   J(q) = sum w_i |x_i - m_i(q)|^2 / (2 sum w_i) + sum W_j (q_j - q_j*)^2 / 2
///
/// over the markers seen in the frame (a missing one is left out). Newton's method, damped as by
/// Levenberg and Marquardt, with analytic Jacobians and the second derivatives of the chains of
/// rotations. In the first frame, and where it stalls or J jumps, again from other postures (the
/// default one and that turned about the vertical), whose solution is taken if J is half or less.
/// Locked coordinates stay at their default value, prescribed ones follow their function, clamped
/// ones stay within their range. Couplers are eliminated, other constraints met in every step
/// (model/constraints.h). Throws InvalidInput if no marker of the file is in the model, or a weight
/// is negative or of no marker of the model; ModelError if the model cannot be posed.
[[nodiscard]] IkResult inverse_kinematics(const model::BodyModel& model,
                                          const recording::MarkerSeries& markers,
                                          const IkOptions& options = {});

}  // namespace myoid::kinematics
