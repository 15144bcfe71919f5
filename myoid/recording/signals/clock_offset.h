#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {

/// The lead of the EMG over the motion, including delays of the body.
struct ClockOffset {
  double lead_s = 0.0;     ///< Positive: a burst of EMG comes before the motion that it drives.
  double scatter_s = 0.0;  ///< Standard deviation, by leaving out each eighth of the recording.
  /// A quarter of the movement's period. Activation leads or lags by up to this where it follows velocity more than
  /// torque, because a muscle's force falls with its speed and the antagonist brakes.
  double phase_s = 0.0;
  double sd_s = 0.0;         ///< Standard deviation of both together.
  double correlation = 0.0;  ///< The largest canonical correlation, at `lead_s`.
};

/// Estimates the lead of EMG envelopes over the motion by the largest canonical correlation (Hotelling 1936) between
/// the envelopes a(t - d) and position and acceleration of the motion, which stand for the torques of gravity and
/// inertia. At most four principal components of the envelopes and two of the motion take part, at 50 Hz, the motion
/// below 4 Hz. The search covers d within `reach_s` to either side. Empty where the lead cannot be told: less than 3 s
/// in common, no motion or a motion slower than a sine of 0.5 Hz (posture then correlates with the EMG at any delay), a
/// correlation below 0.6, the best d at the end of the range, another d as good (gait and other periodic movements),
/// or a scatter above 0.1 s. In virtual recordings whose clocks agree, estimates ranged from -70 to +450
/// ms for movements with a period of 1.2 s. The estimate finds clock errors of half a second; it does not measure the
/// electromechanical delay.
[[nodiscard]] std::optional<ClockOffset> estimate_clock_offset(const TimeSeries& envelopes,
                                                               const TimeSeries& motion,
                                                               double reach_s = 0.6);

/// Reports the offset as a remark, or as a warning if it is outside the limits by more than
/// `phase_s` plus two standard deviations of the scatter. Recordings of 30 s or more are also
/// tested for a drift between the first and the last third.
[[nodiscard]] std::vector<Remark> check_clock_offset(const TimeSeries& envelopes, const TimeSeries& motion);

/// Reports intervals that vary; `what` names the file or the channels.
[[nodiscard]] std::optional<Remark> check_clock_evenness(const Eigen::Ref<const Eigen::VectorXd>& time_s,
                                                         const std::string& what);

}  // namespace myoid::recording
