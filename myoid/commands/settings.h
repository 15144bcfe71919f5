#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/study/setting_rows.h"
#include "myoid/study/study.h"

namespace myoid::commands {

/// The settings of study files: the reference of all, or the values of one study.
struct SettingsOptions {
  Call call;
  std::string study;  ///< study.toml; empty: the reference of all settings.
};

struct SettingsResult {
  std::optional<Study> study;        ///< With all settings that it leaves to their defaults.
  std::vector<SettingTable> tables;  ///< The reference, where no study was named.
};

[[nodiscard]] SettingsResult settings(const SettingsOptions& options);

/// The study as a study file, or the reference for a terminal.
[[nodiscard]] std::string settings_text(const SettingsResult& result);

/// The study as it stands in run.json, or the reference as a list of tables.
[[nodiscard]] std::string settings_json(const SettingsResult& result);

}  // namespace myoid::commands
