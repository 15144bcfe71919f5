#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Returns the source paper's figure 2 for muscle `m` of the study: force-length and force-velocity
/// relations, literature and identified, and the truth of a virtual recording.
[[nodiscard]] page::Figure muscle_curves(const run::StudyResult& result,
                                         const fit::IdentificationResult& method,
                                         std::size_t m);

/// Returns the source paper's figure 6: EMG raw, rectified and filtered, of a trial with EMG. The
/// figure's table begins with `chain`, the steps from EMG to envelope.
[[nodiscard]] page::Figure emg_figure(const run::TrialResult& trial, const std::vector<std::string>& chain);

/// Returns the source paper's figures 8-10: force of every muscle over one trial, in N.
[[nodiscard]] page::Figure force_figure(const run::StudyResult& result,
                                        const fit::TrialData& data,
                                        const fit::IdentificationResult& method);

}  // namespace myoid::results
