#pragma once

#include "myoid/identification/study_data.h"
#include "myoid/identify_files/identify_sources.h"
#include "myoid/identify_files/muscles_csv.h"

namespace myoid {

/// Reads the data of the estimators, on the clock of each trial's lengths and over the time that all of its files
/// cover. `remark` receives repairs, omitted samples and suspicious values, one trial after the other
/// (`check_given_trial`), and trials with equal activations. Throws InvalidInput for files that do not match the
/// number of trials, ReadError for missing columns and files that do not overlap, and as `check_given_trial`.
[[nodiscard]] identification::StudyData read_identify_data(const IdentifySources& sources,
                                                           const MuscleTable& table,
                                                           const TellRemark& remark);

}  // namespace myoid
