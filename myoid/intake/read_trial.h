#pragma once

#include <vector>

#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Parts of a trial between such pauses that are shorter are left out.
inline constexpr double kShortestPart_s = 1.0;

/// Reads one trial; its EMG and loads are put on the clock of its motion before anything else
/// (`trial_clock`). Throws ReadError (file, line, found, expected, remedy) or InvalidInput: a
/// missing EMG channel, angles that are degrees where radians are said, EMG and motion that do not
/// cover one time, a pause of more than kLongestGap_s in a clock (ClockPause), a clock that is not
/// in seconds, a cut-off above half the rate.
[[nodiscard]] TrialInput read_trial_input(const Study& study,
                                          const TrialSpec& trial,
                                          const model::BodyModel& model);

/// A trial, or a part of it.
struct TrialPart {
  TrialSpec spec;
  TrialInput input;
};

/// Reads one trial; one whose clock pauses for more than kLongestGap_s as several, "name.1",
/// "name.2", ..., with a warning: nothing is filtered or interpolated across the pause. Parts of
/// less than kShortestPart_s are left out. Throws as `read_trial_input`, also where nothing is left
/// or the study calibrates coordinates in a window that not every part has.
[[nodiscard]] std::vector<TrialPart> read_trial_parts(const Study& study,
                                                      const TrialSpec& trial,
                                                      const model::BodyModel& model);

}  // namespace myoid
