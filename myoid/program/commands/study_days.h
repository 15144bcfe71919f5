#pragma once

#include "myoid/run/study_result.h"

namespace myoid::program {

/// Writes into the result the day of today, and the days that the files of its trials state.
void add_days(run::StudyResult& result);

}  // namespace myoid::program
