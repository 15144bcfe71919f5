#include "myoid/study/setting_reader.h"

#include <fmt/format.h>

namespace myoid::study {

using ground::TomlTable;

void SettingReader::retired(std::string_view key, std::string_view why, std::vector<std::string>& said) {
  if (table_->asked(key)) said.push_back(fmt::format("the setting {} has no effect: {}", key, why));
}

void SettingReader::must(bool holds, std::string_view key, const std::string& message) {
  if (!holds) table_->fail(key, message);
}

void SettingReader::refuse(const Setting& setting, const std::string& reason) const {
  if (!reason.empty()) table_->fail(setting.key, reason);
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
  refuse(setting, refusal(setting, value));
  return value;
}

SettingValue SettingReader::number(const Setting& setting) {
  const About& about = setting.about;
  if (!about.word.empty() && table_->is_text(setting.key)) {
    const std::string value = *table_->text(setting.key);
    if (value != about.word)
      table_->fail(setting.key, fmt::format("found \"{}\", expected a number or \"{}\"", value, about.word));
    return value;
  }
  const double value = *table_->number(setting.key);
  refuse(setting, refusal(setting, value));
  return value;
}

SettingValue SettingReader::texts(const Setting& setting) {
  const About& about = setting.about;
  std::vector<std::string> value = *table_->texts(setting.key);
  if (!about.word.empty() && value == std::vector<std::string>{std::string(about.word)}) return std::string(about.word);
  for (std::string& each : value) {
    if (setting.kind == SettingKind::paths) {
      if (each.empty()) table_->fail(setting.key, "the path is empty");
      each = (folder_ / each).string();
      continue;
    }
    refuse(setting, refusal(setting, each));
  }
  if (about.count > 0 && value.size() != about.count)
    table_->fail(setting.key, fmt::format("found {} names, expected {}", value.size(), about.count));
  return value;
}

SettingValue SettingReader::numbers(const Setting& setting) {
  const About& about = setting.about;
  std::vector<double> value = *table_->numbers(setting.key);
  if (about.count > 0 && value.size() != about.count)
    table_->fail(setting.key, fmt::format("found {} numbers, expected {}", value.size(), about.count));
  for (const double each : value) refuse(setting, refusal(setting, each));
  return value;
}

SettingValue SettingReader::stretches(const Setting& setting) {
  WordedStretches value;
  const std::vector<TomlTable::NumbersOrText> list = *table_->numbers_or_texts(setting.key);
  for (const TomlTable::NumbersOrText& each : list) {
    const std::string expected =
        fmt::format("expected pairs of times [begin, end] in s{}",
                    setting.about.word.empty() ? "" : fmt::format(" or \"{}\"", setting.about.word));
    if (each.text) {
      if (*each.text != setting.about.word)
        table_->fail(setting.key, fmt::format("found \"{}\", {}", *each.text, expected));
      value.worded = true;
      continue;
    }
    if (each.numbers.size() != 2)
      table_->fail(setting.key, fmt::format("found a list of {} numbers, {}", each.numbers.size(), expected));
    const Stretch stretch{each.numbers[0], each.numbers[1]};
    if (!(stretch.begin_s < stretch.end_s))
      table_->fail(setting.key,
                   fmt::format("found [{}, {}], expected the begin before the end", stretch.begin_s, stretch.end_s));
    value.stretches.push_back(stretch);
  }
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
      const std::string reason = refusal(setting, numbers[name]);
      if (!reason.empty()) inner.fail(name, reason);
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
    case SettingKind::folder:
      set(text(setting));
      break;
    case SettingKind::texts:
    case SettingKind::paths:
      set(texts(setting));
      break;
    case SettingKind::numbers:
      set(numbers(setting));
      break;
    case SettingKind::stretches:
      set(stretches(setting));
      break;
    case SettingKind::texts_by_name:
    case SettingKind::numbers_by_name:
      set(by_name(setting));
      break;
  }
  return true;
}

bool SettingReader::entered(std::string_view key, bool /*present*/, const About& /*about*/, const Inside& inside) {
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
                             const InsideEach& inside) {
  std::size_t i = 0;
  for (TomlTable& each : table_->tables(key)) {
    SettingReader reader(each, folder_);
    inside(i++, reader);
    each.finish();
  }
}

}  // namespace myoid::study
