#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/model/body_model.h"

namespace myoid::kinematics {

/// Coordinates, their rates and accelerations on one clock; channels are the model's coordinates, in its order.
struct JointMotion {
  TimeSeries q;      ///< [rad] or [m]
  TimeSeries qdot;   ///< [rad/s] or [m/s]
  TimeSeries qddot;  ///< [rad/s^2] or [m/s^2]

  [[nodiscard]] Eigen::Index sample_count() const { return q.sample_count(); }
};

struct MotionOptions {
  /// -3 dB of the quintic smoothing spline [Hz]; empty: the interpolating quintic spline, no smoothing.
  std::optional<double> cutoff_hz;
  /// Clock of the result; empty: that of the input.
  std::optional<Eigen::VectorXd> time_s;
};

struct MotionResult {
  JointMotion motion;
  /// Columns that are no coordinate. `implausible` (motion_plausibility.h) names missing coordinates.
  std::vector<std::string> notes;
};

/// Computes values and two derivatives of every coordinate by a quintic spline. `q` has radians and
/// meters; missing coordinates rest at their default value. Throws InvalidInput if no column is a
/// coordinate of the model, a value is not finite, or fewer than four samples are given.
[[nodiscard]] MotionResult joint_motion(const model::BodyModel& model,
                                        const TimeSeries& q,
                                        const MotionOptions& options = {});

/// Returns the unit of a coordinate, its rate or acceleration (order 0, 1, 2).
[[nodiscard]] Unit coordinate_unit(const model::Coordinate& coordinate, int order);

}  // namespace myoid::kinematics
