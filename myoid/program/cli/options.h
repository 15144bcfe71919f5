#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "myoid/program/cli/context.h"
#include "myoid/results/exports/law_differences.h"
#include "myoid/study/setting.h"
#include "myoid/study/study.h"

namespace myoid::program {

/// Adds an option `--key` for every setting that it meets, with the setting's meaning, default and check.
class OptionDeclarer : public study::FlatSettingVisitor {
 public:
  explicit OptionDeclarer(CLI::App& command) : command_(&command) {}

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& now, const Set& set) override;

 private:
  CLI::App* command_;
};

/// Sets every setting whose option the user gave.
class OptionReader : public study::FlatSettingVisitor {
 public:
  explicit OptionReader(const CLI::App& command) : command_(&command) {}

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& now, const Set& set) override;

 private:
  const CLI::App* command_;
};

/// Declares `--truth KEY=VALUE`, and the keys below the help.
void add_truth_option(CLI::App& command, std::vector<std::string>& settings);

/// Adds --export: forms for other programs, separated by commas.
CLI::Option* add_export_option(CLI::App& command, std::vector<results::ExportFormat>& formats);

/// Adds --video and --video-offset: films that the report shows beside the model.
void add_video_options(CLI::App& command, study::VideoChoice& video);

/// The option --mat of commands that fill a folder with results: writes them as one MATLAB file, too.
class MatOption {
 public:
  explicit MatOption(CLI::App& command);
  /// Refuses a file that cannot be written, before anything is computed.
  void prepare(const Context& context, const std::vector<std::string>& inputs) const;
  /// Writes the file if the option is given.
  void write(const std::filesystem::path& folder) const;

 private:
  std::shared_ptr<std::string> file_ = std::make_shared<std::string>();
};

}  // namespace myoid::program
