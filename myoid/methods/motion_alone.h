#pragma once

#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Adds a warning to the result of these data, and makes every `identified` number `weak`, where
/// told_by_motion_alone reaches VerdictRules::motion_alone.
void judge_motion_alone(const StudyData& data, IdentificationResult& result);

}  // namespace myoid::identification
