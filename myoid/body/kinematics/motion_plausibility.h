#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/stretch.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {

/// Limits of a recorded motion.
struct MotionLimits {
  /// Speed of an angle in more than `share` of the time (3,400 deg/s). A pitcher's shoulder turns twice as fast, for
  /// some hundredths of a second.
  double fastest_radps = 60.0;
  double fastest_mps = 50.0;  ///< So of a length.
  double share = 0.05;
  double slowest_hz = 5.0;
  double fastest_hz = 2e4;             ///< No camera and no goniometer is so fast.
  double beyond_rad = 10.0 * kDegree;  ///< Joints go some degrees beyond an author's range.
  double outside_share = 0.5;          ///< Share of samples outside that means another convention.
  double beyond_people_share = 0.02;   ///< Share of samples beyond the angles that people reach.
};
inline constexpr MotionLimits kMotionLimits;

/// Returns "121 samples from 0 to 1000, about one per 8 s: is the time in ms or in frames? ..." for a clock that is too
/// slow for a movement (kMotionLimits.slowest_hz), else an empty text. Fewer than ten samples may be written by hand.
[[nodiscard]] std::string slow_clock(const Eigen::Ref<const Eigen::VectorXd>& time_s);

/// Finds what no movement does, in channels of rad and m: a clock that is too slow or too fast and speeds that no joint
/// has (errors: every speed and torque is wrong), and jumps (recording/signals/motion_jumps.h; warnings). Jumps and
/// speeds count within the stretch.
[[nodiscard]] std::vector<Remark> implausible_motion(const TimeSeries& motion, const Stretch& within = {-1e300, 1e300});

/// Finds an angle that leaves the coordinate's range, or people's where the model's is wider at both ends, by more than
/// 10 degrees. It is an error if the coordinate is clamped and outside of the model's range most of the time.
[[nodiscard]] std::optional<Remark> angle_outside_range(const Coordinate& c,
                                                        const Eigen::Ref<const Eigen::VectorXd>& angle_rad);

/// The same of a motion of a model, with the angle_outside_range errors of joints that people_range knows, and a
/// warning that names the coordinates of the model that the motion lacks, but for locked ones: they rest at their
/// default. Of `needed` coordinates only these are missed; empty: all.
[[nodiscard]] std::vector<Remark> implausible_motion(const body::BodyModel& model,
                                                     const TimeSeries& motion,
                                                     const Stretch& within = {-1e300, 1e300},
                                                     const std::vector<std::string>& needed = {});

}  // namespace myoid::body
