#pragma once

#include <cstddef>
#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/identify_files/identify_sources.h"

namespace myoid {

/// Reads the files of one trial, each once, onto the clock of its lengths and the time that all of its files cover.
/// Excludes stretches in which a file has no samples. `remark` receives repairs, jumps and these stretches. Throws
/// ReadError for missing columns and for files that do not overlap.
[[nodiscard]] identification::TrialData read_identify_trial(const IdentifySources& sources,
                                                            std::size_t number,
                                                            const std::vector<identification::MuscleSetup>& muscles,
                                                            const TellRemark& remark);

}  // namespace myoid
