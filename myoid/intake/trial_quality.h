#pragma once

#include <string>
#include <vector>

#include "myoid/core/fault.h"
#include "myoid/core/time_series.h"
#include "myoid/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid {

/// What moves in a trial: its coordinates, or the paths of the markers that are always there.
[[nodiscard]] TimeSeries movement_of(const TrialInput& input);

/// Faults of a trial's EMG, of its clocks, and of what was found of its markers before they were
/// mended. `envelope` is empty or the trial's EMG envelope.
[[nodiscard]] std::vector<Fault> trial_faults(const Study& study,
                                              const TrialInput& input,
                                              const TimeSeries& envelope);

/// A line per fault for people who want few lines: warnings only, the same kind and channel in
/// several trials said once with the trials' names, at most `most` lines and then how many more.
struct NamedFault {
  std::string trial;  ///< Empty: of the whole study.
  Fault fault;
};
[[nodiscard]] std::vector<std::string> fault_summary(const std::vector<NamedFault>& faults,
                                                     std::size_t most = 12);

}  // namespace myoid
