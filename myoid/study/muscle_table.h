#pragma once

#include "myoid/fit/measurement/study_data.h"
#include "myoid/study/setting.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Visits the settings of one [[muscle]].
void visit(MuscleSpec& muscle, SettingVisitor& v);

/// Visits the settings of one [[parameter]].
void visit(fit::ParameterRule& rule, SettingVisitor& v);

}  // namespace myoid::study
