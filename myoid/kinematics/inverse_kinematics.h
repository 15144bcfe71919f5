#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/core/time_series.h"
#include "myoid/model/body_model.h"
#include "myoid/recording/marker_series.h"

namespace myoid::kinematics {

/// A wish for a coordinate's value: adds W (q - q*)^2 / 2 to the objective.
struct CoordinateTask {
  std::string coordinate;
  double value = 0.0;   ///< q* [rad or m]
  double weight = 1.0;  ///< W
};

struct IkOptions {
  std::map<std::string, double> marker_weights;  ///< By name; markers that are not named weigh 1.
  std::vector<CoordinateTask> tasks;
  int max_iterations = 200;
  Progress progress;
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
  std::vector<double> objective;  ///< Per frame.
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
/// over the markers seen in the frame (a missing one is left out). Levenberg-Marquardt with
/// analytic marker Jacobians, then Newton where residuals are large; where it stalls, again from
/// the default pose. Locked coordinates stay at their default value, clamped ones within their
/// range. Throws InvalidInput if no marker of the file is in the model, or a weight is negative or
/// of no marker of the model; ModelError if the model cannot be posed.
[[nodiscard]] IkResult inverse_kinematics(const model::BodyModel& model,
                                          const recording::MarkerSeries& markers,
                                          const IkOptions& options = {});

}  // namespace myoid::kinematics
