#include "myoid/program/contents/contents_text.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/core/json_text.h"

namespace myoid::program {

using nlohmann::ordered_json;

namespace {

/// Returns JSON in one line.
std::string compact(const ordered_json& value) { return json_text(value, -1); }

std::string number_or_text(const ordered_json& value, int digits) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.{}g}", value.get<double>(), digits);
  return compact(value);
}

bool is_list_of_members(const ordered_json& value) {
  return value.is_array() && !value.empty() && value[0].is_object();
}

/// Returns "mass 1.5 kg" of "mass_kg": a key ends in the unit of its number.
std::string fact_text(const std::string& key, const ordered_json& value) {
  struct Ending {
    std::string_view key, unit;
  };
  std::string label = key;
  std::string_view unit;
  for (const Ending& each : {Ending{"_kg", "kg"}, Ending{"_n", "N"}, Ending{"_m", "m"}, Ending{"_s", "s"},
                             Ending{"_hz", "Hz"}, Ending{"_deg", "deg"}}) {
    if (!value.is_number() || !label.ends_with(each.key)) continue;
    label.resize(label.size() - each.key.size());
    unit = each.unit;
  }
  std::ranges::replace(label, '_', ' ');
  if (value.is_boolean()) return label;
  return fmt::format("{} {}{}{}", label, number_or_text(value, 5), unit.empty() ? "" : " ", unit);
}

/// Returns "BIC [V]  lowest -0.003  highest 0.002" of an object, without its lists and what is false; a list's other
/// members as they are.
std::string member_text(const ordered_json& item) {
  if (!item.is_object()) return number_or_text(item, 6);
  std::string line;
  for (const auto& [key, value] : item.items()) {
    if (is_list_of_members(value) || (value.is_boolean() && !value.get<bool>())) continue;
    if (key == "unit") {
      line += fmt::format("{}[{}]", line.empty() ? "" : " ", number_or_text(value, 5));
    } else {
      line += line.empty() ? "" : "  ";
      line += key == "name" ? number_or_text(value, 5) : fact_text(key, value);
    }
  }
  return line;
}

/// Ending of the key that states the origin of another key's value: "up" and "up_from".
constexpr const char* kFrom = "_from";

bool says_where_from(const ordered_json& contents, const std::string& key) {
  const std::size_t base = key.size() - std::min(key.size(), std::string_view(kFrom).size());
  return key.ends_with(kFrom) && contents.contains(key.substr(0, base));
}

/// Returns a member of a list, and below it the members of its own lists.
std::string lines_of(const ordered_json& item) {
  std::string text = fmt::format("  {}\n", member_text(item));
  if (!item.is_object()) return text;
  for (const auto& [key, value] : item.items()) {
    if (!is_list_of_members(value)) continue;
    for (const auto& member : value) text += fmt::format("    {}\n", member_text(member));
  }
  return text;
}

}  // namespace

std::string contents_text(const ordered_json& contents) {
  std::string text;
  for (const auto& [key, value] : contents.items()) {
    if (says_where_from(contents, key)) continue;
    std::string label = key;
    std::ranges::replace(label, '_', ' ');
    if (!value.is_array()) {
      const auto from = contents.find(key + kFrom);
      text += fmt::format("{}: {}{}\n", label, number_or_text(value, 6),
                          from == contents.end() ? "" : fmt::format(" (from {})", number_or_text(*from, 6)));
    } else if (!value.empty() && value[0].is_number()) {
      text += fmt::format("{}: {}\n", label, compact(value));
    } else if (!value.empty()) {
      text += fmt::format("{} ({}):\n", label, value.size());
      for (const auto& item : value) text += lines_of(item);
    }
  }
  return text;
}

}  // namespace myoid::program
