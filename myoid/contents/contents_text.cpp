#include "myoid/contents/contents_text.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "myoid/core/json_text.h"

namespace myoid {

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

/// Returns "BIC [V]  lowest -0.003  highest 0.002" of an object, without its lists; a list's other members as they are.
std::string member_text(const ordered_json& item) {
  if (!item.is_object()) return number_or_text(item, 6);
  std::string line;
  for (const auto& [key, value] : item.items()) {
    if (is_list_of_members(value)) continue;
    const std::string text = number_or_text(value, 5);
    if (key == "unit") {
      line += fmt::format("{}[{}]", line.empty() ? "" : " ", text);
    } else {
      line += line.empty() ? "" : "  ";
      line += key == "name" ? text : fmt::format("{} {}", key, text);
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

}  // namespace myoid
