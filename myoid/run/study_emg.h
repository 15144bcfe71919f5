#pragma once

#include "myoid/run/study_result.h"
#include "myoid/signals/emg_chain.h"

namespace myoid {

/// Steps by which the activations of a study were made, for the headers of files; without steps
/// where there is no EMG. `method`: of its forces, with the delay that it found; null: before any
/// delay.
[[nodiscard]] signals::EmgChain emg_chain(const StudyResult& result,
                                          const identification::IdentificationResult* method);

}  // namespace myoid
