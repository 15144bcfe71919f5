#pragma once

#include <vector>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/run/identify_files/muscles_csv.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// Returns the muscles of a table as [[muscle]]: names, channels, stated starting values and held parameters. A study
/// takes the other starting values from the literature, as the table does.
[[nodiscard]] std::vector<study::MuscleSpec> muscle_specs(const MuscleTable& table);

/// Returns the rest of a table as [[parameter]]: bounds, priors, values beyond the paper's law, and its rules.
[[nodiscard]] std::vector<fit::ParameterRule> parameter_rules(const MuscleTable& table);

}  // namespace myoid::run
