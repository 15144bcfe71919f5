#include "myoid/recording/angle_file.h"

#include <algorithm>

#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

bool states_degrees(const Storage& file) {
  return std::ranges::any_of(file.header,
                             [](const auto& entry) { return equal_ignoring_case(entry.first, "inDegrees"); });
}

bool is_translation_by_name(const std::string& column) {
  return column.ends_with("_tx") || column.ends_with("_ty") || column.ends_with("_tz");
}

}  // namespace myoid::recording
