#pragma once

#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Where told_by_motion_alone is above VerdictRules::motion_alone, adds a warning to the result of
/// these data and makes every `identified` number `weak`.
void judge_motion_alone(const StudyData& data, IdentificationResult& result);

}  // namespace myoid::identification
