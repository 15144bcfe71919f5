#pragma once

#include <string>

#include "myoid/study/study.h"

namespace myoid {

/// The full options of a study, defaults included, as JSON with the sections and keys of the file.
[[nodiscard]] std::string study_json(const Study& study);

}  // namespace myoid
