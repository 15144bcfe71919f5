#include "myoid/program/commands/settings.h"

#include "myoid/study/read_study.h"
#include "myoid/study/study_text.h"

namespace myoid::program {

SettingsResult settings(const SettingsOptions& options) {
  if (options.study.empty()) return {.study = std::nullopt, .tables = study::setting_tables()};
  return {.study = study::read_study(options.study), .tables = {}};
}

std::string settings_text(const SettingsResult& result) {
  return result.study ? study::study_toml(*result.study) : study::reference_text(result.tables);
}

std::string settings_json(const SettingsResult& result) {
  return result.study ? study::study_json(*result.study) + "\n" : study::reference_json(result.tables);
}

}  // namespace myoid::program
