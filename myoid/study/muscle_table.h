#pragma once

#include "myoid/files/toml_table.h"
#include "myoid/identification/study_data.h"
#include "myoid/study/study.h"

namespace myoid {

/// One [[muscle]] of a study. Throws ReadError with the line for a parameter that no muscle has and
/// for a start outside the parameter's bounds.
[[nodiscard]] MuscleSpec read_muscle(recording::TomlTable table);

/// One [[parameter]] of a study. Throws ReadError with the line for an unknown name, a lower bound
/// not below the upper one and a standard deviation that is not positive.
[[nodiscard]] identification::ParameterRule read_rule(recording::TomlTable table);

}  // namespace myoid
