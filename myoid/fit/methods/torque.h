#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/intervals/verdicts.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Fits all muscles of the joints and both branches together, from all calibration trials, to the torque of inverse
/// dynamics:
///
///   T^(t) = sum_i r_i F_i(g a_i(t - d), l_i, v_i; x_i)
///
/// The unknowns are F_max, l0, l_sh, V_sh, P and V_ml of each muscle (positive ones as logarithms), the EMG delay d, a
/// gain g per EMG channel, and further numbers that `StudyData::rules` free. Estimates, intervals and verdicts are
/// those of one posterior (fit/posterior/posterior.h). Verdicts are capped by `caps_of_torque`. Throws InvalidInput for
/// data that do not fit together. A search that fails does not throw: read `termination`.
[[nodiscard]] IdentificationResult identify_torque(const StudyData& data, const EstimatorOptions& options = {});

/// Returns the options with a memory of the drives behind the envelopes, which fits of one recording share.
[[nodiscard]] EstimatorOptions remembering_drives(EstimatorOptions options);

/// Returns the exact fit of data without noise (exact_fit) with its predictions; empty if there is none.
[[nodiscard]] std::optional<IdentificationResult> identify_exactly(const StudyData& data,
                                                                   const EstimatorOptions& options = {});

/// Returns the caps that the data themselves put on a fit's verdicts, and warns of each in the result: motion alone
/// tells the torque (told_by_motion_alone, VerdictRules::motion_alone), or the EMG is late (emg_clock.h).
[[nodiscard]] std::vector<VerdictCap> caps_of_torque(const StudyData& data,
                                                     const EstimatorOptions& options,
                                                     IdentificationResult& result);

}  // namespace myoid::fit
