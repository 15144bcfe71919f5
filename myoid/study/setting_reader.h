#pragma once

#include <filesystem>

#include "myoid/ground/files/toml_table.h"
#include "myoid/study/setting.h"

namespace myoid::study {

/// Reads settings from a table of a TOML file. A setting that the file does not give keeps its value; paths are
/// resolved against `folder`. Throws ReadError with the line for a wrong type, a refused number or word, and settings
/// that exclude each other. The caller checks the table for unknown keys at the end (TomlTable::finish).
class SettingReader : public SettingVisitor {
 public:
  SettingReader(TomlTable& table, std::filesystem::path folder) : table_(&table), folder_(std::move(folder)) {}

  void retired(std::string_view key, std::string_view why, std::vector<std::string>& said) override;
  void must(bool holds, std::string_view key, const std::string& message) override;

 protected:
  bool met(const Setting& setting, const SettingValue& now, const Set& set) override;
  bool entered(std::string_view key, bool present, const About& about, const Inside& inside) override;
  void repeated(std::string_view key, std::size_t count, const About& about, const InsideEach& inside) override;

 private:
  [[nodiscard]] SettingValue text(const Setting& setting);
  [[nodiscard]] SettingValue number(const Setting& setting);
  [[nodiscard]] SettingValue texts(const Setting& setting);
  [[nodiscard]] SettingValue numbers(const Setting& setting);
  [[nodiscard]] SettingValue stretches(const Setting& setting);
  [[nodiscard]] SettingValue by_name(const Setting& setting);
  /// Throws ReadError at the setting's line if there is a reason to refuse the setting.
  void refuse(const Setting& setting, const std::string& reason) const;

  TomlTable* table_;
  std::filesystem::path folder_;
};

/// Reads one table of a study as its struct: `read_spec<TrialSpec>(table, folder)`. Throws
/// ReadError as SettingReader does, and for an unknown key with the nearest known one.
template <typename Spec>
[[nodiscard]] Spec read_spec(TomlTable table, const std::filesystem::path& folder) {
  Spec spec;
  SettingReader reader(table, folder);
  visit(spec, reader);
  table.finish();
  return spec;
}

}  // namespace myoid::study
