#pragma once

#include <string>

#include "myoid/study/study.h"

namespace myoid::study {

/// Returns the full settings of a study, defaults included, as JSON with the tables and keys of the
/// file; null: not given. Paths are absolute or relative to the working directory.
[[nodiscard]] std::string study_json(const Study& study);

/// Returns the settings as a study file at `study.file`: read_study of it gives the same study.
[[nodiscard]] std::string study_toml(const Study& study);

}  // namespace myoid::study
