#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Hashes of short stretches of a recording's samples, sorted. The same samples give the same
/// hashes in any file, format, window or clock.
using Stretches = std::vector<std::uint64_t>;

/// Hashes stretches of 32 samples of all channels together. A rule on their own content selects a
/// quarter of them; stretches that do not change are skipped. All channels take part because a
/// single noiseless channel, such as one of a resting muscle, may be equal in two trials.
[[nodiscard]] Stretches stretches_of(const TimeSeries& series);

/// Returns the share of the shorter recording that is in the other, too.
[[nodiscard]] double common_share(const Stretches& a, const Stretches& b);

/// The files and stretches of a trial.
struct TrialPrint {
  std::string trial;
  Use use = Use::calibration;
  std::string emg_file, motion_file;  ///< Names for messages.
  Stretches emg, movement;
};
[[nodiscard]] TrialPrint print_of(const TrialSpec& spec, const TrialInput& input);

/// Finds the same recording in two trials. It is an error if one EMG is combined with two movements or one effort
/// counts twice. It is a warning if two EMGs are combined with one movement, or if a maximal contraction repeats a
/// trial. One file may serve several trials with windows that do not overlap, and several maximal contractions.
[[nodiscard]] std::vector<Remark> same_recordings(const std::vector<TrialPrint>& trials);

}  // namespace myoid::study
