#pragma once

#include <string>
#include <vector>

#include "myoid/ground/core/stretch.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::recording {

/// A moment in which a channel changes faster than a movement can.
struct MotionJump {
  std::string channel;
  Unit unit = Unit::radian;  ///< Unit of the channel: rad or m.
  double time_s = 0.0;
  double speed = 0.0;  ///< Greatest speed [rad/s, m/s].
  int count = 0;       ///< Number of such moments in this channel.

  /// Returns "'elbow' moves at 812 deg/s at 3.995 s, ...", with the remedy.
  [[nodiscard]] std::string sentence() const;
};

/// Limits beyond which a change is too fast and too short for a movement.
struct MotionJumpLimits {
  double radps = 2.5;   ///< Speed of an angle (143 deg/s).
  double mps = 0.5;     ///< Speed of a length.
  double ratio = 3.0;   ///< Ratio of the speed to its 95 % quantile.
  double for_s = 0.08;  ///< Time for which the speed stays above half of its peak.
};
inline constexpr MotionJumpLimits kJumpLimits;

/// Finds moments at which an angle [rad] or a length [m] changes too fast for too short a time. The speed |dx/dt|
/// between samples exceeds the limit of its unit and `ratio` times its own 95 % quantile, and stays above half of that
/// peak for less than `for_s` (joints speed up and slow down over a tenth of a second). A wrong sample, a step, and
/// both after smoothing have this pattern; repeated fast movements raise the quantile and do not. One entry a channel,
/// at its greatest such speed within the stretch; the quantile is that of the whole motion. Channels of other units are
/// skipped.
[[nodiscard]] std::vector<MotionJump> find_motion_jumps(const TimeSeries& motion,
                                                        const Stretch& within = {-1e300, 1e300});

}  // namespace myoid::recording
