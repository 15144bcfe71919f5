#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "myoid/program/cli/context.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Adds an option `--key` for every setting of the visit, with its meaning, default and check.
void declare_visited(CLI::App& command, const study::SettingVisitor::Inside& visit_all);
/// Sets every setting of the visit whose option the user gave.
void read_visited(const CLI::App& command, const study::SettingVisitor::Inside& visit_all);

/// Declares the options of a command, whose struct `visit` describes.
template <typename Options>
void declare_options(CLI::App& command) {
  declare_visited(command, [usual = Options()](study::SettingVisitor& v) mutable { visit(usual, v); });
}

/// Returns the options as the user gave them, with the common ones.
template <typename Options>
[[nodiscard]] Options given_options(const CLI::App& command, const Context& context) {
  Options options;
  read_visited(command, [&](study::SettingVisitor& v) { visit(options, v); });
  options.call = context.call();
  return options;
}

/// Adds a command that takes the options of a struct, and the common ones; `run` does its work.
template <typename Options>
CLI::App* add_command(CLI::App& app,
                      Context& context,
                      const char* name,
                      const char* says,
                      const CommonOptions& used,
                      void (*run)(Context&, const Options&, const CLI::App&)) {
  CLI::App* const command = app.add_subcommand(name, says);
  declare_options<Options>(*command);
  add_common_options(*command, context, used);
  command->callback([command, &context, run] { run(context, given_options<Options>(*command, context), *command); });
  return command;
}

/// Refuses a MATLAB file that cannot be written, before anything is computed; an empty name is none.
void prepare_mat(const Context& context, const std::string& file, const std::vector<std::string>& inputs);
/// Writes the results in the folder as a MATLAB file, if it has a name.
void write_mat(const std::string& file, const std::filesystem::path& folder);

}  // namespace myoid::program
