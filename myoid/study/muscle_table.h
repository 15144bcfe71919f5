#pragma once

#include "myoid/identification/study_data.h"
#include "myoid/study/setting.h"
#include "myoid/study/study.h"

namespace myoid {

/// Visits the settings of one [[muscle]].
void visit(MuscleSpec& muscle, SettingVisitor& v);

/// Visits the settings of one [[parameter]].
void visit(identification::ParameterRule& rule, SettingVisitor& v);

}  // namespace myoid
