#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

/// Coordinates, their rates and accelerations on one clock; channels are the model's coordinates, in its order.
struct JointMotion {
  TimeSeries q;      ///< [rad] or [m]
  TimeSeries qdot;   ///< [rad/s] or [m/s]
  TimeSeries qddot;  ///< [rad/s^2] or [m/s^2]

  [[nodiscard]] Eigen::Index sample_count() const { return q.sample_count(); }
};

/// Who gives the values of a coordinate that the model locks or prescribes: the recorded motion, as in OpenSim's
/// inverse dynamics, or the model, as in OpenSim's analyses.
enum class HeldValues { of_motion, of_model };

struct MotionOptions {
  /// -3 dB of the quintic smoothing spline [Hz]; empty: the interpolating quintic spline, no smoothing.
  std::optional<double> cutoff_hz;
  /// Clock of the result; empty: that of the input.
  std::optional<Eigen::VectorXd> time_s;
  HeldValues held = HeldValues::of_motion;
};

struct MotionResult {
  JointMotion motion;
  /// Columns that are no coordinate; locked and prescribed coordinates whose values differ from the model's.
  /// `implausible` (motion_plausibility.h) names missing coordinates.
  std::vector<Remark> notes;
};

/// Computes values and two derivatives of every coordinate by a quintic spline. `q` has radians and
/// meters; missing coordinates rest at their default value. Throws InvalidInput if no column is a
/// coordinate of the model, a value is not finite, or fewer than four samples are given.
[[nodiscard]] MotionResult joint_motion(const body::BodyModel& model,
                                        const TimeSeries& q,
                                        const MotionOptions& options = {});

/// Returns the values that the model gives a locked or prescribed coordinate at these times.
[[nodiscard]] Eigen::VectorXd held_values(const body::Coordinate& coordinate, const Eigen::VectorXd& times_s);
/// Returns true for a locked or prescribed coordinate.
[[nodiscard]] bool is_held(const body::Coordinate& coordinate);

/// Returns a remark on each locked or prescribed coordinate whose values in `q` differ from those of the model by
/// more than rounding: its name, both ranges, and which values count.
[[nodiscard]] std::vector<Remark> held_notes(const body::BodyModel& model, const TimeSeries& q, HeldValues held);

/// Returns the motion with the values and accelerations of locked and prescribed coordinates that the model gives, and
/// with their rates if `rates_too`: OpenSim's analyses keep the rates of the motion.
[[nodiscard]] JointMotion with_held_values(const body::BodyModel& model, JointMotion motion, bool rates_too);

/// Returns the unit of a coordinate, its rate or acceleration (order 0, 1, 2).
[[nodiscard]] Unit coordinate_unit(const body::Coordinate& coordinate, int order);

}  // namespace myoid::body
