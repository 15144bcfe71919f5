#pragma once

#include <string>
#include <vector>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/recording/orientation_reader.h"

namespace myoid::body {

/// A sensor fixed to a body of the model.
struct SensorOnBody {
  std::size_t column = 0;  ///< Column of the sensor in the series.
  body::BodyIndex body = 0;
  Mat3 R_BS = Mat3::Identity();
  double weight = 1.0;
};

struct OrientationFit {
  TimeSeries q;                     ///< All coordinates, in the model's order [rad | m].
  TimeSeries errors_rad;            ///< Angle of each sensor to its measured orientation, or NaN.
  std::vector<FrameStatus> status;  ///< Per frame.
  int frames_not_converged = 0, frames_without_sensors = 0;
  std::vector<std::string> open_coordinates;  ///< Free coordinates that the sensors leave open.
};

/// Finds the pose of the model that fits the measured orientations best, frame by frame:
///
///   minimize  sum_i w_i theta_i^2 / 2,
///
/// where theta_i is the angle between a sensor's frame in the model and its measured orientation, over the sensors seen
/// in the frame, as in OpenSim. Inverse kinematics of three points on the axes of each sensor, in a model whose bodies
/// only turn, gives the least sum_i w_i (1 - cos theta_i); Gauss-Newton steps refine it. Translational coordinates keep
/// their default values. Throws InvalidInput for no sensor or a weight below 0, ModelError for a model with closed
/// loops, in which places matter.
[[nodiscard]] OrientationFit fit_orientations(const body::BodyModel& model,
                                              const recording::OrientationSeries& series,
                                              const std::vector<SensorOnBody>& sensors,
                                              const Progress& progress = {});

}  // namespace myoid::body
