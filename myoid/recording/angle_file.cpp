#include "myoid/recording/angle_file.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "myoid/files/text_file.h"

namespace myoid::recording {

bool may_hold_angles(const Storage& file) {
  const auto speaks_of_other = [](std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::string_view kOthers[] = {"force",      "torque",     "moment",    "emg",
                                            "electromyo", "activation", "excitation"};
    return std::ranges::any_of(kOthers, [&](std::string_view word) { return text.find(word) != std::string::npos; });
  };
  return !speaks_of_other(file.title) &&
         !std::ranges::all_of(file.data.channels(), [&](const Channel& c) { return speaks_of_other(c.name); });
}

bool states_degrees(const Storage& file) {
  return std::ranges::any_of(file.header,
                             [](const auto& entry) { return equal_ignoring_case(entry.first, "inDegrees"); });
}

bool is_translation_by_name(const std::string& column) {
  return column.ends_with("_tx") || column.ends_with("_ty") || column.ends_with("_tz");
}

}  // namespace myoid::recording
