#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"
#include "myoid/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid {

/// Hashes of short stretches of a recording's samples, sorted: the same samples give the same
/// hashes in whatever file, format, window or clock they come.
using Stretches = std::vector<std::uint64_t>;

/// Of the stretches of 32 samples of all channels together those that a rule of their own content
/// picks, a quarter of them; none of samples that do not change. A single channel may be alike in
/// two trials where nothing is noisy, as of muscles that rest in both.
[[nodiscard]] Stretches stretches_of(const TimeSeries& series);

/// Share of the shorter recording that is in the other, too.
[[nodiscard]] double common_share(const Stretches& a, const Stretches& b);

/// What a trial consists of.
struct TrialPrint {
  std::string trial;
  Use use = Use::calibration;
  std::string emg_file, motion_file;  ///< Names for messages.
  Stretches emg, movement;
};
[[nodiscard]] TrialPrint print_of(const TrialSpec& spec, const TrialInput& input);

/// The same recording in two trials: an error where one EMG is said to have driven two movements,
/// or one effort is counted twice; a warning where two EMGs are said to have driven one movement,
/// or a maximal contraction is only a trial once more. The same file may serve several trials with
/// windows that do not overlap, and several maximal contractions.
[[nodiscard]] std::vector<Remark> same_recordings(const std::vector<TrialPrint>& trials);

}  // namespace myoid
