#pragma once

#include "myoid/run/study_result.h"
#include "myoid/signals/emg_chain.h"

namespace myoid {

/// Returns the steps from EMG to the activations of a study, for the headers of files; none without
/// EMG. `method`: adds the delay that the method found; null: no delay.
[[nodiscard]] signals::EmgChain emg_chain(const StudyResult& result,
                                          const identification::IdentificationResult* method);

}  // namespace myoid
