#pragma once

#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {

/// The words that a remedy may use.
enum class EmgRemedies {
  keys_of_study,   ///< Keys of study.toml.
  options_of_emg,  ///< Options of `myoid emg`, which makes activations of the recording.
  none             ///< The recording is looked at alone.
};

/// The filters that the EMG will pass, and who reads the remedies.
struct EmgTreatment {
  bool high_passed = true;
  bool notched = true;  ///< Notches take out hum.
  EmgRemedies remedies = EmgRemedies::keys_of_study;
};

/// Checks one trial's raw EMG (volts, finite), channel by channel and pair by pair:
///
/// - spike (artifact): `find_spikes`. The other checks see the signal without its spikes;
/// - amplitude: beyond `amplitude_v`, which neither skin nor amplifier gives; of channels that lie beyond it more than
///   an artifact does (`is_beyond_amplifiers`) one remark tells another unit;
/// - envelope: never negative, and through its median less than `raw_hz` times a second, so that the signal has been
///   rectified and smoothed, or `is_rectified`. Of the other checks only flat stretches then apply;
/// - flat: no change at all for `flat_s`, or an rms below `flat_v` throughout;
/// - clipped (no envelope, whose samples are few and smooth): flat tops of three samples or more, and more samples on
/// the largest (or smallest) value than in the
///   twentieth of the range next to it; saturated: one such top for `saturated_s`;
/// - hum: `find_hum` above `hum_share`. Of a channel of nothing but noise (`is_noise`) nothing more is said:
///   `check_emg_levels` does;
/// - drift: standard deviation of the means over 1 s, divided by the rms above 20 Hz. Grave only if the EMG will not be
///   high-passed (`high_passed` false);
/// - artifact: rms between 1 and 15 Hz in some quarter second, divided by the largest rms above 20 Hz of any quarter
///   second;
/// - crosstalk: the largest correlation of two channels above 20 Hz, without hum, within 10 ms.
[[nodiscard]] std::vector<Remark> check_emg(const TimeSeries& raw, const EmgTreatment& treatment = {});

}  // namespace myoid::recording
