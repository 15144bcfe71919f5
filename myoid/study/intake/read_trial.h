#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Shortest part of a trial between pauses that is kept.
inline constexpr double kShortestPart_s = 1.0;

/// Reads one trial and puts its EMG and loads on the clock of its motion first (`trial_clock`). Throws ReadError (file,
/// line, found, expected, remedy) or InvalidInput for a missing EMG channel, degrees in a file that states radians, EMG
/// and motion at different times, a pause of more than kLongestGap_s in a clock (ClockPause), a clock not in seconds,
/// and a cut-off above half the rate.
[[nodiscard]] TrialInput read_trial_input(const Study& study, const TrialSpec& trial, const body::BodyModel& model);

/// A trial, or a part of it.
struct TrialPart {
  TrialSpec spec;
  TrialInput input;
};

/// Reads one trial. A trial whose clock pauses for more than kLongestGap_s becomes several, "name.1", "name.2", ...,
/// with a warning: nothing is filtered or interpolated across the pause. Parts of less than kShortestPart_s are left
/// out. Motion that lasts 0.1 s or more beyond the file of its torques or forces is left out, with a warning. Throws as
/// `read_trial_input`, also if no part is left, if less than half of the motion has loads, or if the study calibrates
/// coordinates in a window, which not every part contains.
[[nodiscard]] std::vector<TrialPart> read_trial_parts(const Study& study,
                                                      const TrialSpec& trial,
                                                      const body::BodyModel& model);

}  // namespace myoid::study
