#pragma once

#include <filesystem>

#include "myoid/report/workbench.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Returns the values that the report of a run shows over time: of each trial its angles, torques,
/// EMG, activations and muscle forces as the result files hold them, its channels at a glance, the
/// faults found in them, and the muscles whose numbers the reader can move. A plot has at most
/// 15,000 samples over all trials (of one trial at least 250): every k-th sample of the file, raw
/// EMG as its least and greatest value in equal stretches. A trial's film has its path from
/// `folder`, in which the report lies.
[[nodiscard]] report::Workbench study_workbench(const StudyResult& result,
                                                const std::filesystem::path& folder);

}  // namespace myoid
