#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"
#include "myoid/signals/quality_limits.h"

namespace myoid::signals {

/// By how much the EMG's clock is ahead of the motion's, delays of the body included.
struct ClockOffset {
  double lead_s = 0.0;     ///< Positive: a burst of EMG comes before the motion that it drives.
  double scatter_s = 0.0;  ///< Standard deviation, by leaving out each eighth of the recording.
  /// A quarter of the movement's period: where activation follows velocity (a muscle's force falls
  /// with its speed, the other one brakes) more than the torque, it is ahead or behind by up to
  /// that.
  double phase_s = 0.0;
  double sd_s = 0.0;         ///< Of both together.
  double correlation = 0.0;  ///< The largest canonical correlation, at `lead_s`.
};

/// Compares the EMG's envelopes a(t - d) with what the muscles have to provide for: position and
/// acceleration of the motion (the torque of gravity and that of inertia), by the largest canonical
/// correlation of the two (Hotelling 1936) over d. At most four principal components of the
/// envelopes and two of the motion take part, at 50 Hz, the motion below 4 Hz. Searched within
/// `reach_s` either way. Empty where it cannot be told: less than 3 s in common, no motion or one
/// slower than a sine of 0.5 Hz (posture then goes with the EMG at any delay), a correlation below
/// 0.6, the best d at the end of the range, another d nearly as good (searched beyond 0.6 s only),
/// or a scatter above 0.1 s. On virtual recordings whose clocks agree it was 70 ms behind to 450 ms
/// ahead in movements of a period of 1.2 s: it finds errors of clocks of half a second, it does not
/// measure the electromechanical delay.
[[nodiscard]] std::optional<ClockOffset> estimate_clock_offset(const TimeSeries& envelopes,
                                                               const TimeSeries& motion,
                                                               double reach_s = 0.6);

/// The offset as a remark, or a warning where it lies outside the limits by more than `phase_s` and
/// two standard deviations of the scatter; from 30 s on, a drift between the first and the last
/// third.
[[nodiscard]] std::vector<Remark> check_clock_offset(const TimeSeries& envelopes,
                                                     const TimeSeries& motion,
                                                     const QualityLimits& limits = {});

/// Intervals that vary; `what` names the file or the channels.
[[nodiscard]] std::optional<Remark> check_clock_evenness(
    const Eigen::Ref<const Eigen::VectorXd>& time_s,
    const std::string& what,
    const QualityLimits& limits = {});

}  // namespace myoid::signals
