#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/program/commands/call.h"
#include "myoid/study/setting_rows.h"
#include "myoid/study/study.h"

namespace myoid::program {

/// Options of the list of study settings: the reference of all, or the values of one study.
struct SettingsOptions {
  Call call;
  std::string study;  ///< study.toml; empty: the reference of all settings.
};

struct SettingsResult {
  std::optional<study::Study> study;        ///< The study, with defaults for the settings that it omits.
  std::vector<study::SettingTable> tables;  ///< The reference, if no study was named.
};

[[nodiscard]] SettingsResult settings(const SettingsOptions& options);

/// Returns the study as a study file, or the reference for a terminal.
[[nodiscard]] std::string settings_text(const SettingsResult& result);

/// Returns the study as in run.json, or the reference as a list of tables.
[[nodiscard]] std::string settings_json(const SettingsResult& result);

}  // namespace myoid::program
