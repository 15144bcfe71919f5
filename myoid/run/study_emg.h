#pragma once

#include "myoid/recording/signals/emg_chain.h"
#include "myoid/run/study_result.h"

namespace myoid::run {

/// Returns the steps from EMG to the activations of a study, for the headers of files; none without
/// EMG. `method`: adds the delay that the method found; null: no delay.
[[nodiscard]] recording::EmgChain emg_chain(const StudyResult& result, const fit::IdentificationResult* method);

}  // namespace myoid::run
