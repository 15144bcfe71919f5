#include "myoid/study/setting_rows.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/wrapped_text.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/study/study_settings.h"

namespace myoid::study {
namespace {

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

std::string words_of(const Setting& setting) {
  std::vector<std::string> words;
  for (const std::string_view word : setting.about.words) {
    if (!word.empty()) words.push_back(code(word));
  }
  const std::string list = fmt::format("{}", fmt::join(words, ", "));
  return setting.kind == SettingKind::texts ? "one or several of " + list : list;
}

std::string type_of(const Setting& setting, bool option) {
  const About& about = setting.about;
  const std::string several = about.count > 0 ? fmt::format("{} ", about.count) : "";
  switch (setting.kind) {
    case SettingKind::flag:
      return option ? "no value" : "true, false";
    case SettingKind::number:
      return range_text(about.limits);
    case SettingKind::count:
      return "whole, " + range_text(about.limits);
    case SettingKind::text:
      return about.words.empty() ? "text" : words_of(setting);
    case SettingKind::path:
      return "file";
    case SettingKind::folder:
      return "folder";
    case SettingKind::texts:
      if (!about.words.empty()) return words_of(setting);
      return option ? "one or several" : several + "text or list of texts";
    case SettingKind::paths:
      return option ? "one or several" : "file or list of files";
    case SettingKind::numbers:
      if (option) return several + range_text(about.limits);
      return fmt::format("{}numbers{}", several,
                         about.limits.unit.empty() ? "" : fmt::format(" [{}]", about.limits.unit));
    case SettingKind::stretches:
      return "list of [begin, end] [s]";
    case SettingKind::texts_by_name:
      return "table of texts";
    case SettingKind::numbers_by_name:
      return "table of numbers, " + range_text(about.limits);
  }
  return "";
}

std::string allowed(const Setting& setting, bool option) {
  std::string text = type_of(setting, option);
  const About& about = setting.about;
  if (setting.kind == SettingKind::texts && about.count > 0) text = fmt::format("{} texts", about.count);
  if (!about.word.empty())
    text += fmt::format(", {} `\"{}\"`", setting.kind == SettingKind::stretches ? "and" : "or", about.word);
  if (!about.table.empty()) text += fmt::format(", or `{{ {} = … }}`", about.table);
  return text;
}

std::string default_of(const Setting& setting, const SettingValue& value, bool option) {
  const About& about = setting.about;
  if (!about.required.empty()) return "required";
  if (!about.otherwise.empty()) return std::string(about.otherwise);
  if (const auto* flag = std::get_if<bool>(&value)) return option ? (*flag ? "on" : "off") : (*flag ? "true" : "false");
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string>(&value); text != nullptr && !text->empty())
    return code(option ? *text : toml_text(*text));
  if (const auto* list = std::get_if<std::vector<std::string>>(&value); list != nullptr && !list->empty()) {
    std::vector<std::string> quoted;
    if (option) return code(fmt::format("{}", fmt::join(*list, " ")));
    std::transform(list->begin(), list->end(), std::back_inserter(quoted), toml_text);
    return list->size() == 1 ? code(quoted.front()) : code(fmt::format("[{}]", fmt::join(quoted, ", ")));
  }
  if (const auto* list = std::get_if<std::vector<double>>(&value); list != nullptr)
    return code(option ? fmt::format("{}", fmt::join(*list, " ")) : fmt::format("[{}]", fmt::join(*list, ", ")));
  return "–";
}

/// Describes the settings of one table.
class RowVisitor : public SettingVisitor {
 public:
  RowVisitor(std::string prefix, std::vector<SettingRow>& rows) : prefix_(std::move(prefix)), rows_(&rows) {}

 protected:
  bool met(const Setting& setting, const SettingValue& now, const Set& /*set*/) override {
    rows_->push_back(setting_row(setting, now, SettingNotation::file));
    rows_->back().key.insert(0, prefix_);
    return false;
  }
  bool entered(std::string_view key, bool /*present*/, const About& about, const Inside& inside) override {
    rows_->push_back({prefix_ + std::string(key), "table", about.otherwise.empty() ? "–" : std::string(about.otherwise),
                      std::string(about.says)});
    if (key == "sync") return false;  // the table [sync] describes its settings
    RowVisitor rows(prefix_ + std::string(key) + ".", *rows_);
    inside(rows);
    return false;
  }
  void repeated(std::string_view /*key*/,
                std::size_t /*count*/,
                const About& /*about*/,
                const InsideEach& /*inside*/) override {}

 private:
  std::string prefix_;
  std::vector<SettingRow>* rows_;
};

/// Describes the tables of a study.
class TableVisitor : public SettingVisitor {
 public:
  std::vector<SettingTable> tables;

 protected:
  bool met(const Setting& /*setting*/, const SettingValue& /*now*/, const Set& /*set*/) override { return false; }
  bool entered(std::string_view key, bool /*present*/, const About& about, const Inside& inside) override {
    SettingTable table{fmt::format("[{}]", key), std::string(about.says), {}};
    RowVisitor rows("", table.rows);
    inside(rows);
    tables.push_back(std::move(table));
    return false;
  }
  void repeated(std::string_view key, std::size_t /*count*/, const About& about, const InsideEach& inside) override {
    SettingTable table{fmt::format("[[{}]]", key), std::string(about.says), {}};
    RowVisitor rows("", table.rows);
    inside(0, rows);
    tables.push_back(std::move(table));
  }
};

}  // namespace

std::string range_text(const SettingLimits& limits) {
  const std::string unit = limits.unit.empty() ? "" : fmt::format(" {}", limits.unit);
  if (std::isfinite(limits.upper)) return fmt::format("{} to {}{}", limits.lower, limits.upper, unit);
  if (std::isfinite(limits.lower)) {
    return limits.above_lower ? fmt::format("above {}{}", limits.lower, unit)
                              : fmt::format("{}{} or more", limits.lower, unit);
  }
  return limits.unit.empty() ? "number" : fmt::format("number [{}]", limits.unit);
}

std::string without_markdown(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "](") == 0 && text.find(')', i) != std::string::npos) {
      const std::size_t opened = result.rfind('[');
      if (opened != std::string::npos) result.erase(opened, 1);
      i = text.find(')', i);
    } else if (text[i] != '`') {
      result += text[i];
    }
  }
  return result;
}

SettingRow setting_row(const Setting& setting, const SettingValue& usual, SettingNotation notation) {
  const bool option = notation == SettingNotation::command_line;
  return {(option ? "--" : "") + std::string(setting.key), allowed(setting, option), default_of(setting, usual, option),
          std::string(setting.about.says)};
}

std::string reference_text(const std::vector<SettingTable>& tables, std::size_t width) {
  std::string text;
  for (const SettingTable& table : tables) {
    text += wrapped(fmt::format("{} {}", table.name, without_markdown(table.says)), width, 0, 2);
    for (const SettingRow& row : table.rows) {
      text += wrapped(
          fmt::format("{}: {}; default {}", row.key, without_markdown(row.allowed), without_markdown(row.usual)), width,
          2, 6);
      text += wrapped(without_markdown(row.says), width, 6);
    }
    text += '\n';
  }
  return text;
}

std::string reference_json(const std::vector<SettingTable>& tables) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SettingTable& table : tables) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const SettingRow& row : table.rows)
      rows.push_back({{"key", row.key},
                      {"values", without_markdown(row.allowed)},
                      {"default", without_markdown(row.usual)},
                      {"meaning", without_markdown(row.says)}});
    list.push_back({{"table", table.name}, {"meaning", without_markdown(table.says)}, {"settings", rows}});
  }
  return json_text(list) + "\n";
}

std::vector<SettingTable> setting_tables() {
  Study study;
  TableVisitor visitor;
  visit(study, visitor);
  return std::move(visitor.tables);
}

std::string markdown(const std::vector<SettingRow>& rows, std::string_view heading) {
  std::string text = fmt::format("| {} | values | default | meaning |\n| --- | --- | --- | --- |\n", heading);
  for (const SettingRow& row : rows)
    text += fmt::format("| `{}` | {} | {} | {} |\n", row.key, row.allowed, row.usual, row.says);
  return text;
}

}  // namespace myoid::study
