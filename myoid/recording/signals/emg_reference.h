#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/recording/signals/emg_envelope.h"

namespace myoid::recording {

/// A half second of an EMG channel that is far above everything else in the recordings.
struct LonePeak {
  std::size_t trial = 0;                       ///< Number of the trial.
  Eigen::Index first_sample = 0, samples = 0;  ///< The half second and what the filter's flanks reach of its sides.
  double begin_s = 0.0, end_s = 0.0;           ///< The half second itself, on the trial's clock.
  double ratio = 0.0;                          ///< Its mean over that of the next half second.
  bool at_end = false;                         ///< Its middle is within half a second of an end of the recording.
  /// False: no other half second is an effort (four times the quietest), so that this one has to serve all the same.
  bool replaced = true;
};

/// Returns the half seconds of a channel that no other effort confirms, the greatest first: each is more than
/// `kLimits.levels.lone_reference` times the next that does not overlap it. At the ends of a recording of 3 s or more,
/// where amplifiers settle and cables are pulled, `kLimits.levels.lone_reference_at_end` is enough, and half seconds at
/// other ends do not count as the next. An effort of a muscle lasts, or comes again.
[[nodiscard]] std::vector<LonePeak> lone_peaks(std::span<const TrialEnvelope> trials, const std::string& channel);

/// True if `count` samples from `first` of this trial touch a peak that another effort replaces.
[[nodiscard]] bool touches(const std::vector<LonePeak>& peaks,
                           std::size_t trial,
                           Eigen::Index first,
                           Eigen::Index count);

}  // namespace myoid::recording
