#pragma once

#include <string>
#include <vector>

namespace myoid {

/// A setting as the reference describes it.
struct SettingRow {
  std::string key;      ///< "lowpass_hz"; within a table in a table "held_mass.body".
  std::string allowed;  ///< Type, range and unit, or the words: "10 to 2000 Hz".
  std::string usual;    ///< Default.
  std::string says;     ///< One sentence or two; Markdown.
};

/// A table of study.toml.
struct SettingTable {
  std::string name;  ///< "[emg]", "[[trial]]"
  std::string says;
  std::vector<SettingRow> rows;
};

/// The reference of study.toml: every table and setting in the order of the visits.
[[nodiscard]] std::vector<SettingTable> setting_tables();

/// The rows of a table as Markdown, which docs/guide/study.md holds.
[[nodiscard]] std::string markdown(const SettingTable& table);

/// The reference for a terminal, and for machines as a list of tables.
[[nodiscard]] std::string reference_text(const std::vector<SettingTable>& tables);
[[nodiscard]] std::string reference_json(const std::vector<SettingTable>& tables);

}  // namespace myoid
