#pragma once

#include <filesystem>

#include "myoid/page/workbench.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Returns the values that the report of a run shows over time: for each trial its angles, torques, EMG, activations
/// and muscle forces as in the result files, an overview of its channels, the faults in them, and the muscles whose
/// numbers the reader can move. A plot has at most 15,000 samples over all trials (for one trial at least 250): every
/// k-th sample of the file, for raw EMG the least and greatest value in equal stretches. A trial's film has its path
/// from `folder`, in which the report lies.
[[nodiscard]] page::Workbench study_workbench(const run::StudyResult& result, const std::filesystem::path& folder);

}  // namespace myoid::results
