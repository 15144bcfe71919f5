#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/intervals/result.h"
#include "myoid/report/report.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Returns the source paper's figure 2 for muscle `m` of the study: force-length and force-velocity
/// relations, literature and identified, and the truth of a virtual recording.
[[nodiscard]] report::Figure muscle_curves(const StudyResult& result,
                                           const identification::IdentificationResult& method,
                                           std::size_t m);

/// Returns the source paper's figure 6: EMG raw, rectified and filtered, of a trial with EMG. The
/// figure's table begins with `chain`, the steps from EMG to envelope.
[[nodiscard]] report::Figure emg_figure(const TrialResult& trial, const std::vector<std::string>& chain);

/// Returns the source paper's figures 8-10: force of every muscle over one trial, in N.
[[nodiscard]] report::Figure force_figure(const StudyResult& result,
                                          const identification::TrialData& data,
                                          const identification::IdentificationResult& method);

}  // namespace myoid
