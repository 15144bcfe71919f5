#pragma once

#include <string>
#include <vector>

#include "myoid/study/setting.h"

namespace myoid::study {

/// A setting as the reference describes it.
struct SettingRow {
  std::string key;      ///< "lowpass_hz"; within a table in a table "held_mass.body".
  std::string allowed;  ///< Type, range and unit, or the words: "10 to 2000 Hz".
  std::string usual;    ///< Default.
  std::string says;     ///< One sentence or two; Markdown.
};

/// The notation in which settings are written and described.
enum class SettingNotation {
  file,         ///< A line of study.toml: `loss = "huber"`.
  command_line  ///< An option: `--loss huber`.
};

/// Returns the row of a setting; `usual` is the value without any input of the user.
[[nodiscard]] SettingRow setting_row(const Setting& setting, const SettingValue& usual, SettingNotation notation);

/// Returns the allowed numbers: "10 to 2000 Hz", "above 0 s", "number".
[[nodiscard]] std::string range_text(const SettingLimits& limits);

/// A table of study.toml.
struct SettingTable {
  std::string name;  ///< "[emg]", "[[trial]]"
  std::string says;
  std::vector<SettingRow> rows;
};

/// Returns the reference of study.toml: every table and setting in the order of the visits.
[[nodiscard]] std::vector<SettingTable> setting_tables();

/// Returns the rows as Markdown with the heading `heading`, for pages of docs/guide.
[[nodiscard]] std::string markdown(const std::vector<SettingRow>& rows, std::string_view heading = "key");

/// Returns the text without Markdown's marks: `code` and [text](address).
[[nodiscard]] std::string without_markdown(const std::string& markdown);

/// Returns the reference for a terminal of this width, and for machines as a list of tables.
[[nodiscard]] std::string reference_text(const std::vector<SettingTable>& tables, std::size_t width = 100);
[[nodiscard]] std::string reference_json(const std::vector<SettingTable>& tables);

/// Collects the rows of settings outside tables.
class OptionRows : public FlatSettingVisitor {
 public:
  explicit OptionRows(SettingNotation notation = SettingNotation::command_line) : notation_(notation) {}
  std::vector<SettingRow> rows;

 protected:
  bool met(const Setting& setting, const SettingValue& now, const Set& /*set*/) override {
    rows.push_back(setting_row(setting, now, notation_));
    return false;
  }

 private:
  SettingNotation notation_;
};

/// Returns the rows of a command's options: `option_rows(IdentifyOptions{})`.
template <typename Options>
[[nodiscard]] std::vector<SettingRow> option_rows(Options options) {
  OptionRows visitor;
  visit(options, visitor);
  return visitor.rows;
}

}  // namespace myoid::study
