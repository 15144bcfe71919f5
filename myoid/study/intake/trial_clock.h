#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "myoid/ground/core/time_series.h"
#include "myoid/recording/signals/clock_map.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Usual lead of EMG envelopes over the motion that they drive: 60 ± 20 ms of electromechanical
/// delay and activation, and ± 50 ms from cocontraction and braking.
inline constexpr double kUsualLead_s = 0.06;
inline constexpr double kUsualLeadSd_s = 0.054;

/// The relation of a trial's EMG clock to the clock of its motion.
struct TrialClock {
  recording::ClockMap clock;
  std::string source;  ///< "as the study says", "5 edges of 'Sync' and 'Trig'", ...
};

/// Receives every further file that is read.
using Remember = std::function<void(const std::filesystem::path&)>;

/// Finds the clock of the trial's EMG by the study's [sync] or the trial's own: numbers, instants or a signal in both
/// recordings, or "estimate": the offset at which `envelopes` lead `movement` by kUsualLead_s, with the uncertainty of
/// that lead. Empty if there is nothing to correct: no [sync], no motion, or EMG and motion in one file. `envelopes` is
/// called for "estimate" only. Throws ReadError or InvalidInput if a trigger is missing or cannot be matched, or if the
/// estimate fails.
[[nodiscard]] std::optional<TrialClock> trial_clock(const Study& study,
                                                    const TrialSpec& trial,
                                                    const TimeSeries& movement,
                                                    const std::function<TimeSeries()>& envelopes,
                                                    const Remember& remember);

/// Returns the sync settings of a trial; nullptr if there are none.
[[nodiscard]] const SyncSpec* sync_of(const Study& study, const TrialSpec& trial);

/// Returns the clock of the file of a trial's loads, if it differs from the motion's.
[[nodiscard]] std::optional<recording::ClockMap> loads_clock(const Study& study,
                                                             const TrialSpec& trial,
                                                             const std::filesystem::path& file);

}  // namespace myoid::study
