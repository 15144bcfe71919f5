#pragma once

#include <vector>

#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"
#include "myoid/signals/quality_limits.h"

namespace myoid::signals {

/// Checks one trial's raw EMG (volts, finite), channel by channel and pair by pair:
///
/// - amplitude: beyond `amplitude_v`, which neither skin nor amplifier gives;
/// - envelope: never negative, and through its median less than `raw_hz` times a second, so that the signal has been
///   rectified and smoothed. Of the other checks only flat stretches then apply;
/// - flat: no change at all for `flat_s`, or an rms below `flat_v` throughout;
/// - clipped: flat tops of three samples or more, and more samples on the largest (or smallest) value than in the
///   twentieth of the range next to it; saturated: one such top for `saturated_s`;
/// - hum: `find_hum` above `hum_share`;
/// - drift: standard deviation of the means over 1 s, divided by the rms above 20 Hz. Grave only if the EMG will not be
///   high-passed (`high_passed` false);
/// - artifact: rms between 1 and 15 Hz in some quarter second, divided by the largest rms above 20 Hz of any quarter
///   second;
/// - crosstalk: the largest correlation of two channels above 20 Hz, without hum, within 10 ms.
[[nodiscard]] std::vector<Remark> check_emg(const TimeSeries& raw, bool high_passed = true);

/// True for rectified and smoothed EMG: the samples are never negative (except for a filter's swing
/// of 5 %) and go through their median less than `raw_hz` times a second.
[[nodiscard]] bool is_envelope(const Eigen::Ref<const Eigen::VectorXd>& samples, double rate_hz);

}  // namespace myoid::signals
