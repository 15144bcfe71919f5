#pragma once

#include <string>

#include "myoid/study/study.h"

namespace myoid {

/// The full settings of a study, defaults included, as JSON with the tables and keys of the file;
/// null: not given. Paths stand as the program opens them.
[[nodiscard]] std::string study_json(const Study& study);

/// The same as a study file that stands where `study.file` does: read_study of it gives the same
/// study.
[[nodiscard]] std::string study_toml(const Study& study);

}  // namespace myoid
