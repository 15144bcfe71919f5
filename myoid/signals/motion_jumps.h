#pragma once

#include <string>
#include <vector>

#include "myoid/core/time_series.h"

namespace myoid::signals {

/// A moment in which a channel changes faster than a movement can.
struct MotionJump {
  std::string channel;
  Unit unit = Unit::radian;  ///< Of the channel: rad or m.
  double time_s = 0.0;
  double speed = 0.0;  ///< Greatest [rad/s, m/s].
  int count = 0;       ///< Such moments of this channel.

  /// "'elbow' moves at 812 deg/s at 3.995 s, ...", with what to do.
  [[nodiscard]] std::string sentence() const;
};

/// When an angle or a length changes too fast for too short a time.
struct MotionJumpLimits {
  double radps = 2.5;   ///< Speed of an angle (143 deg/s) ...
  double mps = 0.5;     ///< ... or of a length ...
  double ratio = 3.0;   ///< ... over the speed that it does not exceed 95 % of the time ...
  double for_s = 0.08;  ///< ... for less than this above half of its peak.
};

/// Moments at which an angle [rad] or a length [m] changes faster than the rest of the movement and
/// for too short a time to be one: its speed |dx/dt| between samples exceeds the limit of its unit
/// and `ratio` times its own 95 % quantile, and stays above half of that peak for less than `for_s`
/// (joints speed up and slow down over a tenth of a second). A sample that is off, a step, and both
/// after smoothing look like that; repeated fast movements raise the quantile and do not. One entry
/// per channel, at its greatest such speed. Channels of other units are not looked at.
[[nodiscard]] std::vector<MotionJump> find_motion_jumps(const TimeSeries& motion,
                                                        const MotionJumpLimits& limits = {});

}  // namespace myoid::signals
