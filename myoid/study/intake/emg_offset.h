#pragma once

#include <vector>

#include "myoid/study/intake/trial_input.h"

namespace myoid::study {

/// Takes off the constant that the envelope of one trial has beside the muscle's activity, and returns a warning for
/// each, with the trial in `where`. A channel has such a constant c if
///
/// - its 2nd percentile c is recording::kLimits.levels.offset times that of another trial, and at least 3 % of its own
/// 98th,
/// - the envelope comes back to within 5 % of c ten times or more, for a tenth of the trial in all.
///
/// The mean of rectified EMG over a pause of 0.2 s varies by a sixth: neither noise nor a tense muscle is that steady.
/// The envelope e becomes e - c, 0 below. Activations keep their constant, because they may be computed; the warning
/// says so. A high-pass takes constants of raw EMG out.
[[nodiscard]] std::vector<Remark> take_off_emg_offsets(const Study& study, std::vector<TrialInput>& inputs);

}  // namespace myoid::study
