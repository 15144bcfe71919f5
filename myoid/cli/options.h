#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "myoid/study/setting.h"

namespace myoid::cli {

/// Adds an option `--key` for every setting that it meets, with the setting's meaning, default and check.
class OptionDeclarer : public FlatSettingVisitor {
 public:
  explicit OptionDeclarer(CLI::App& command) : command_(&command) {}

 protected:
  bool met(const Setting& setting, const SettingValue& now, const Set& set) override;

 private:
  CLI::App* command_;
};

/// Sets every setting whose option the user gave.
class OptionReader : public FlatSettingVisitor {
 public:
  explicit OptionReader(const CLI::App& command) : command_(&command) {}

 protected:
  bool met(const Setting& setting, const SettingValue& now, const Set& set) override;

 private:
  const CLI::App* command_;
};

/// Declares the options of a command whose struct of options has a `visit`.
template <typename Options>
void add_options(CLI::App& command) {
  Options defaults;
  OptionDeclarer declarer(command);
  visit(defaults, declarer);
}

/// Returns the options that the user gave; the others have their defaults.
template <typename Options>
[[nodiscard]] Options read_options(const CLI::App& command) {
  Options options;
  OptionReader reader(command);
  visit(options, reader);
  return options;
}

/// Declares `--truth KEY=VALUE`, and the keys below the help.
void add_truth_option(CLI::App& command, std::vector<std::string>& settings);

}  // namespace myoid::cli
