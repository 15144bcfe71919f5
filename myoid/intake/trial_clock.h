#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "myoid/core/time_series.h"
#include "myoid/signals/clock_map.h"
#include "myoid/study/study.h"

namespace myoid {

/// By how much people's EMG envelopes lead the motion that they drive, and what that varies by:
/// 60 ± 20 ms of electromechanical delay and activation, and ± 50 ms by cocontraction and braking.
inline constexpr double kUsualLead_s = 0.06;
inline constexpr double kUsualLeadSd_s = 0.054;

/// How the EMG of a trial stands to the clock of its motion.
struct TrialClock {
  signals::ClockMap clock;
  std::string source;  ///< "as the study says", "5 edges of 'Sync' and 'Trig'", ...
};

/// The clock of the trial's EMG by the study's [sync] or the trial's own: numbers, instants or a
/// signal that both recordings hold, or "estimate": the offset at which `envelopes` lead `movement`
/// by kUsualLead_s, with that as its uncertainty. Empty where there is nothing to put right: no
/// [sync], no motion, or EMG and motion of one file. `envelopes` is asked for with "estimate" only.
/// Throws ReadError or InvalidInput where a trigger is not there, cannot be matched, or nothing can
/// be told.
[[nodiscard]] std::optional<TrialClock> trial_clock(
    const Study& study,
    const TrialSpec& trial,
    const TimeSeries& movement,
    const std::function<TimeSeries()>& envelopes,
    const std::function<void(const std::filesystem::path&)>& remember);

/// What is in force for a trial; nullptr if nothing is.
[[nodiscard]] const SyncSpec* sync_of(const Study& study, const TrialSpec& trial);

/// The clock of the file of a trial's loads, if it is not that of the motion.
[[nodiscard]] std::optional<signals::ClockMap> loads_clock(const Study& study,
                                                           const TrialSpec& trial,
                                                           const std::filesystem::path& file);

}  // namespace myoid
