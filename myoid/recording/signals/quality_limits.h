#pragma once

#include "myoid/recording/amplifier_range.h"

namespace myoid::recording {

/// Limits hold for markers.
struct MarkerLimits {
  double gap_s = 0.2;           ///< Longest gap that a spline may fill.
  double missing_share = 0.25;  ///< Share of a marker's frames.
  double jump_m = 0.02;         ///< Distance from the path through the neighboring frames.
  double swap_m = 0.02;         ///< Two markers nearer than this cannot be told apart.
  double rigid_m = 0.03;        ///< Change of a distance within a segment (skin moves 1 to 2 cm).
  double rigid_share = 0.15;    ///< Change of a distance relative to itself.
};

/// Limits hold for one channel of EMG.
struct EmgLimits {
  double amplitude_v = kMostVolts;  ///< Skin gives 10 mV at most.
  double amplitude_share = kShareBeyond;
  double raw_hz = 30.0;            ///< Crossings of the median per second: EMG that has fewer and is never
                                   ///< negative is an envelope.
  double flat_s = 0.25;            ///< Time without any change.
  double flat_v = 1e-7;            ///< Rms below the noise of every amplifier.
  double clipped_share = 1e-4;     ///< Share of the samples that are on flat tops.
  double saturated_s = 0.02;       ///< Length of one flat top.
  double hum_share = 0.10;         ///< Share of the power above 20 Hz in lines of the mains.
  double signal_to_rest = 4.0;     ///< Largest over smallest rms, 12 dB.
  double crosstalk = 0.5;          ///< Correlation of two raw channels.
  double drift_over_rms = 2.0;     ///< Wander of the baseline below 1 Hz over the rms above 20 Hz.
  double artifact_over_rms = 3.0;  ///< Amplitude between 1 and 15 Hz over the loudest EMG above 20 Hz.
  double spike_s = 1e-3;           ///< Width of a spike; EMG behind an amplifier's band is wider.
  double spike_over_emg = 5.0;     ///< Height of a spike over the 98th percentile around it.
  double ecg_alike = 0.8;          ///< Correlation of a beat of the heart with the others; bursts of EMG have none.
  double ecg_irregular = 0.15;     ///< Median departure of the beats' intervals from their median, over it.
  double rectified_share = 0.02;   ///< Samples near zero of rectified EMG.
};

/// A channel beyond these limits holds no EMG.
struct NoiseLimits {
  double flatness = 0.8;  ///< Bandwidth over that of white noise; EMG has 0.2 to 0.65.
  double rms_v = 1e-5;    ///< No amplifier is so noisy.
  double rises = 1.5;     ///< Largest over smallest level of a channel that is nothing but noise.
  double level = 2.0;     ///< Factor between the level of such noise and the channel's rest.
};

/// Limits hold for the levels of one channel over the trials.
struct LevelLimits {
  double over_reference = 1.1;         ///< A movement's effort over that of the maximal contraction.
  double lone_reference = 3.0;         ///< Greatest half second over the next: an effort lasts, or comes again.
  double lone_reference_at_end = 1.5;  ///< The same within half a second of an end of a recording.
  /// The same ratio in all channels, of efforts and of quietest levels, that only another unit makes.
  double other_unit = 10.0;
  double gain = 2.5;        ///< The same ratio to the other trials: the gain of an amplifier.
  double gain_alone = 5.0;  ///< Of a single channel, whose muscle may be more tense in one trial.
  double offset = 3.0;      ///< A constant of an envelope over the lowest level of another trial.
  double gain_alike = 3.0;  ///< Such ratios differ by less than this factor.
};

/// Limits hold for clocks.
struct ClockLimits {
  double uneven_share = 0.05;  ///< Standard deviation of the intervals over their mean.
  /// Least lead of EMG over motion; in people the lead is 10 to 150 ms.
  double earliest_offset_s = -0.1;
  double latest_offset_s = 0.30;  ///< Greatest lead; heavy smoothing adds up to 300 ms.
  double drift_s = 0.05;          ///< Change of that lead from the first to the last third.
};

/// Limits hold for force plates.
struct PlateLimits {
  double offset_n = 10.0;  ///< Vertical force on an empty plate.
  double loaded_n = 50.0;  ///< Vertical force from which the center of pressure is checked.
  double margin_m = 0.02;  ///< Distance that it may be outside the corners.
  /// Share of the loaded time for which it may be farther outside.
  double outside_share = 0.01;
};

/// Limits beyond which a recording is at fault. docs/guide/check.md has the same table; a test compares the two.
struct QualityLimits {
  MarkerLimits markers;
  EmgLimits emg;
  NoiseLimits noise;
  LevelLimits levels;
  ClockLimits clocks;
  PlateLimits plates;
};
inline constexpr QualityLimits kLimits;

}  // namespace myoid::recording
