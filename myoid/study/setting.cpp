#include "myoid/study/setting.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/nearest_word.h"

namespace myoid::study {

namespace {

/// Returns "; is it in mm? Divide by 1000" if that would make an allowed number.
std::string other_unit(double value, const SettingLimits& limits) {
  struct Slip {
    std::string_view meant, written;
    double factor;
  };
  for (const Slip& slip : {Slip{"m", "cm", 100.0}, Slip{"m", "mm", 1000.0}, Slip{"s", "ms", 1000.0}}) {
    const double meant = value / slip.factor;
    if (limits.unit == slip.meant && meant >= limits.lower && meant <= limits.upper && meant != 0.0)
      return fmt::format("; is it in {}? Divide by {}", slip.written, slip.factor);
  }
  return "";
}

std::string expected(const SettingLimits& limits) {
  const std::string unit = limits.unit.empty() ? "" : fmt::format(" {}", limits.unit);
  if (std::isfinite(limits.upper)) return fmt::format("{} to {}{}", limits.lower, limits.upper, unit);
  if (limits.above_lower)
    return limits.lower == 0.0 ? "a positive number" : fmt::format("a number above {}", limits.lower);
  return fmt::format("{} or more", limits.lower);
}

/// Returns the setter of a value that a file holds as a T.
template <typename T, typename Value>
auto set_as(Value& value) {
  return [&value](const SettingValue& given) { value = std::get<T>(given); };
}

template <typename T>
SettingValue or_nothing(const std::optional<T>& value) {
  return value ? SettingValue(*value) : SettingValue();
}

}  // namespace

std::string refusal(const Setting& setting, double value) {
  if (!std::isfinite(value)) return "expected a finite number";
  const SettingLimits& limits = setting.about.limits;
  const bool low = limits.above_lower ? !(value > limits.lower) : !(value >= limits.lower);
  if (low || value > limits.upper)
    return fmt::format(
        "found {}{}{}, expected {}{}{}", value, limits.unit.empty() ? "" : " ", limits.unit, expected(limits),
        setting.about.word.empty() ? "" : fmt::format(" or \"{}\"", setting.about.word), other_unit(value, limits));
  if (setting.kind == SettingKind::count && value != std::floor(value))
    return fmt::format("found {}, expected a whole number", value);
  return "";
}

std::string refusal(const Setting& setting, const std::string& word) {
  const ChoiceNames words = setting.about.words;
  if (words.empty() || std::ranges::find(words, word) != words.end()) return "";
  std::vector<std::string> named;
  for (const std::string_view each : words) {
    if (!each.empty()) named.emplace_back(each);
  }
  return fmt::format("found \"{}\"{}, expected {}{}", word, did_you_mean(word, named),
                     named.size() > 1 ? "one of " : "", fmt::join(named, ", "));
}

bool is_number(const Setting& setting) {
  return setting.kind == SettingKind::number || setting.kind == SettingKind::count ||
         setting.kind == SettingKind::numbers;
}

bool SettingVisitor::flag(std::string_view key, bool& value, const About& about) {
  return met({key, SettingKind::flag, about}, value, set_as<bool>(value));
}

bool SettingVisitor::flag(std::string_view key, std::optional<bool>& value, const About& about) {
  return met({key, SettingKind::flag, about}, or_nothing(value), set_as<bool>(value));
}

bool SettingVisitor::either(std::string_view key, bool& value, const About& about) {
  return met({key, SettingKind::text, about}, std::string(about.words[value ? 1 : 0]),
             [&](SettingValue given) { value = std::get<std::string>(given) == about.words[1]; });
}

bool SettingVisitor::number(std::string_view key, double& value, const About& about) {
  return met({key, SettingKind::number, about}, value, set_as<double>(value));
}

bool SettingVisitor::number(std::string_view key, std::optional<double>& value, const About& about) {
  return met({key, SettingKind::number, about}, or_nothing(value), set_as<double>(value));
}

bool SettingVisitor::number(std::string_view key, std::optional<double>& value, bool& worded, const About& about) {
  return met({key, SettingKind::number, about}, worded ? SettingValue(std::string(about.word)) : or_nothing(value),
             [&](SettingValue given) {
               worded = std::holds_alternative<std::string>(given);
               value.reset();
               if (!worded) value = std::get<double>(given);
             });
}

bool SettingVisitor::text(std::string_view key, std::string& value, const About& about) {
  return met({key, SettingKind::text, about}, value, set_as<std::string>(value));
}

bool SettingVisitor::text(std::string_view key,
                          std::string& value,
                          std::optional<std::string>& instead,
                          const About& about) {
  using Table = std::map<std::string, std::string>;
  const std::string other(about.table);
  return met({key, SettingKind::text, about}, instead ? SettingValue(Table{{other, *instead}}) : SettingValue(value),
             [&](SettingValue given) {
               if (const auto* table = std::get_if<Table>(&given)) {
                 instead = table->at(other);
               } else {
                 value = std::get<std::string>(given);
               }
             });
}

bool SettingVisitor::path(std::string_view key, std::filesystem::path& value, const About& about) {
  return met({key, SettingKind::path, about}, value.empty() ? SettingValue() : SettingValue(value.string()),
             set_as<std::string>(value));
}

bool SettingVisitor::path(std::string_view key, std::string& value, const About& about) {
  return met({key, SettingKind::path, about}, value, set_as<std::string>(value));
}

bool SettingVisitor::folder(std::string_view key, std::string& value, const About& about) {
  return met({key, SettingKind::folder, about}, value, set_as<std::string>(value));
}

bool SettingVisitor::folder(std::string_view key, std::filesystem::path& value, const About& about) {
  return met({key, SettingKind::folder, about}, value.string(), set_as<std::string>(value));
}

bool SettingVisitor::path(std::string_view key, std::optional<std::filesystem::path>& value, const About& about) {
  return met({key, SettingKind::path, about}, value ? SettingValue(value->string()) : SettingValue(),
             set_as<std::string>(value));
}

bool SettingVisitor::texts(std::string_view key, std::vector<std::string>& value, const About& about) {
  const bool worded = value.empty() && !about.word.empty();
  return met({key, SettingKind::texts, about}, worded ? SettingValue(std::string(about.word)) : SettingValue(value),
             [&](SettingValue given) {
               const auto* list = std::get_if<std::vector<std::string>>(&given);
               value = list != nullptr ? *list : std::vector<std::string>{};
             });
}

bool SettingVisitor::paths(std::string_view key, std::vector<std::filesystem::path>& value, const About& about) {
  std::vector<std::string> names;
  for (const std::filesystem::path& path : value) names.push_back(path.string());
  return met({key, SettingKind::paths, about}, names.empty() ? SettingValue() : SettingValue(names),
             [&value](const SettingValue& given) {
               const auto& list = std::get<std::vector<std::string>>(given);
               value.assign(list.begin(), list.end());
             });
}

bool SettingVisitor::paths(std::string_view key, std::vector<std::string>& value, const About& about) {
  return met({key, SettingKind::paths, about}, value, set_as<std::vector<std::string>>(value));
}

bool SettingVisitor::numbers(std::string_view key, std::vector<double>& value, const About& about) {
  return met({key, SettingKind::numbers, about}, value.empty() ? SettingValue() : SettingValue(value),
             set_as<std::vector<double>>(value));
}

bool SettingVisitor::stretches(std::string_view key, std::vector<Stretch>& value, bool& worded, const About& about) {
  const bool empty = value.empty() && !worded;
  return met({key, SettingKind::stretches, about},
             empty ? SettingValue() : SettingValue(WordedStretches{value, worded}), [&](SettingValue given) {
               auto& list = std::get<WordedStretches>(given);
               value = std::move(list.stretches);
               worded = list.worded;
             });
}

bool SettingVisitor::texts_by_name(std::string_view key,
                                   std::map<std::string, std::string>& value,
                                   const About& about) {
  return met({key, SettingKind::texts_by_name, about}, value, set_as<std::map<std::string, std::string>>(value));
}

bool SettingVisitor::numbers_by_name(std::string_view key, std::map<std::string, double>& value, const About& about) {
  return met({key, SettingKind::numbers_by_name, about}, value, set_as<std::map<std::string, double>>(value));
}

void SettingVisitor::retired(std::string_view /*key*/, std::string_view /*why*/, std::vector<std::string>& /*said*/) {}
void SettingVisitor::must(bool /*holds*/, std::string_view /*key*/, const std::string& /*message*/) {}

}  // namespace myoid::study
