#pragma once

#include <string>

#include "myoid/recording/tables/storage_reader.h"

namespace myoid::recording {

/// Returns true if the header says inDegrees, yes or no.
[[nodiscard]] bool states_degrees(const Storage& file);

/// Returns true for the name of a column that is a length by OpenSim's habit: "pelvis_tx".
[[nodiscard]] bool is_translation_by_name(const std::string& column);

}  // namespace myoid::recording
