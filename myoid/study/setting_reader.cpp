#include "myoid/study/setting_reader.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace myoid {

namespace {

using recording::TomlTable;

/// "; is it in mm? Divide by 1000" where that would make an allowed number.
std::string other_unit(double value, const SettingLimits& limits) {
  struct Slip {
    std::string_view meant, written;
    double factor;
  };
  for (const Slip& slip :
       {Slip{"m", "cm", 100.0}, Slip{"m", "mm", 1000.0}, Slip{"s", "ms", 1000.0}}) {
    const double meant = value / slip.factor;
    if (limits.unit == slip.meant && meant >= limits.lower && meant <= limits.upper && meant != 0.0)
      return fmt::format("; is it in {}? Divide by {}", slip.written, slip.factor);
  }
  return "";
}

std::string expected(const SettingLimits& limits) {
  const std::string unit = limits.unit.empty() ? "" : fmt::format(" {}", limits.unit);
  if (std::isfinite(limits.upper))
    return fmt::format("{} to {}{}", limits.lower, limits.upper, unit);
  if (limits.above_lower)
    return limits.lower == 0.0 ? "a positive number"
                               : fmt::format("a number above {}", limits.lower);
  return fmt::format("{} or more", limits.lower);
}

}  // namespace

void SettingReader::must(bool holds, std::string_view key, const std::string& message) {
  if (!holds) table_->fail(key, message);
}

void SettingReader::allow(const TomlTable& table,
                          std::string_view key,
                          const SettingLimits& limits,
                          std::string_view word,
                          double value) const {
  if (!std::isfinite(value)) table.fail(key, "expected a finite number");
  const bool low = limits.above_lower ? !(value > limits.lower) : !(value >= limits.lower);
  if (!low && value <= limits.upper) return;
  table.fail(key, fmt::format("found {}{}{}, expected {}{}{}", value,
                              limits.unit.empty() ? "" : " ", limits.unit, expected(limits),
                              word.empty() ? "" : fmt::format(" or \"{}\"", word),
                              other_unit(value, limits)));
}

void SettingReader::allow(const Setting& setting, const std::string& word) const {
  const ChoiceNames words = setting.about.words;
  if (words.empty() || std::find(words.begin(), words.end(), word) != words.end()) return;
  std::vector<std::string> named;
  for (const std::string_view each : words) {
    if (!each.empty()) named.emplace_back(each);
  }
  const auto near = recording::nearest_word(word, named);
  table_->fail(setting.key, fmt::format("found \"{}\"{}, expected {}{}", word,
                                        near ? fmt::format(" (did you mean '{}'?)", *near) : "",
                                        named.size() > 1 ? "one of " : "", fmt::join(named, ", ")));
}

SettingValue SettingReader::text(const Setting& setting) {
  const About& about = setting.about;
  if (!about.table.empty() && table_->is_table(setting.key)) {
    TomlTable inner = *table_->table(setting.key);
    std::map<std::string, std::string> value{
        {std::string(about.table), inner.require_text(about.table, "a name in quotes")}};
    inner.finish();
    return value;
  }
  std::string value = *table_->text(setting.key);
  if (setting.kind == SettingKind::path) {
    if (value.empty()) table_->fail(setting.key, "the path is empty");
    return (folder_ / value).string();
  }
  allow(setting, value);
  return value;
}

SettingValue SettingReader::number(const Setting& setting) {
  const About& about = setting.about;
  if (!about.word.empty() && table_->is_text(setting.key)) {
    const std::string value = *table_->text(setting.key);
    if (value != about.word)
      table_->fail(setting.key,
                   fmt::format("found \"{}\", expected a number or \"{}\"", value, about.word));
    return value;
  }
  const double value = *table_->number(setting.key);
  allow(*table_, setting.key, about.limits, about.word, value);
  if (setting.kind == SettingKind::count && value != std::floor(value))
    table_->fail(setting.key, fmt::format("found {}, expected a whole number", value));
  return value;
}

SettingValue SettingReader::texts(const Setting& setting) {
  const About& about = setting.about;
  std::vector<std::string> value = *table_->texts(setting.key);
  if (!about.word.empty() && value == std::vector<std::string>{std::string(about.word)})
    return std::string(about.word);
  for (const std::string& each : value) allow(setting, each);
  if (about.count > 0 && value.size() != about.count)
    table_->fail(setting.key,
                 fmt::format("found {} names, expected {}", value.size(), about.count));
  return value;
}

SettingValue SettingReader::numbers(const Setting& setting) {
  const About& about = setting.about;
  std::vector<double> value = *table_->numbers(setting.key);
  if (about.count > 0 && value.size() != about.count)
    table_->fail(setting.key,
                 fmt::format("found {} numbers, expected {}", value.size(), about.count));
  for (const double each : value) allow(*table_, setting.key, about.limits, "", each);
  return value;
}

SettingValue SettingReader::by_name(const Setting& setting) {
  TomlTable inner = *table_->table(setting.key);
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;
  for (const std::string& name : inner.keys()) {
    if (setting.kind == SettingKind::texts_by_name) {
      texts[name] = *inner.text(name);
    } else {
      numbers[name] = *inner.number(name);
      allow(inner, name, setting.about.limits, "", numbers[name]);
    }
  }
  if (setting.kind == SettingKind::texts_by_name) return texts;
  return numbers;
}

bool SettingReader::met(const Setting& setting, const SettingValue& /*now*/, const Set& set) {
  if (!setting.about.required.empty() && !table_->has(setting.key))
    (void)table_->require_text(setting.key, setting.about.required);
  if (!table_->asked(setting.key)) return false;
  switch (setting.kind) {
    case SettingKind::flag:
      set(*table_->flag(setting.key));
      break;
    case SettingKind::number:
    case SettingKind::count:
      set(number(setting));
      break;
    case SettingKind::text:
    case SettingKind::path:
      set(text(setting));
      break;
    case SettingKind::texts:
      set(texts(setting));
      break;
    case SettingKind::numbers:
      set(numbers(setting));
      break;
    case SettingKind::texts_by_name:
    case SettingKind::numbers_by_name:
      set(by_name(setting));
      break;
  }
  return true;
}

bool SettingReader::entered(std::string_view key,
                            bool /*present*/,
                            const About& /*about*/,
                            const Inside& inside) {
  std::optional<TomlTable> inner = table_->table(key);
  if (!inner) return false;
  SettingReader reader(*inner, folder_);
  inside(reader);
  inner->finish();
  return true;
}

void SettingReader::repeated(std::string_view key,
                             std::size_t /*count*/,
                             const About& /*about*/,
                             const std::function<void(std::size_t, SettingVisitor&)>& inside) {
  std::size_t i = 0;
  for (TomlTable& each : table_->tables(key)) {
    SettingReader reader(each, folder_);
    inside(i++, reader);
    each.finish();
  }
}

}  // namespace myoid
