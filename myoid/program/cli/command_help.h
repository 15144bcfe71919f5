#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace myoid::program {

/// An option or argument as help, manual pages and completions show it.
struct HelpOption {
  std::vector<std::string> names;  ///< "-h", "--help"; empty for a positional argument.
  std::string value;               ///< "FILE", "{a,b}", the positional's name; empty for a flag.
  std::vector<std::string> words;  ///< The words that the value may be; empty: any.
  std::string says;                ///< With range, default and the options that it needs or excludes.
  std::string group;               ///< Heading under which it stands.
  bool required = false;
  bool several = false;
};

/// A command as help, manual pages and completions show it.
struct HelpCommand {
  std::string name;
  std::string stands_for;             ///< Name of the command of which `name` is another name; empty: its own name.
  std::string group;                  ///< Heading under which the program's help lists it.
  std::string says;                   ///< First paragraph.
  std::vector<std::string> examples;  ///< Command lines, each as one line.
  std::vector<HelpOption> options, positionals;

  /// Returns the first sentence without its point.
  [[nodiscard]] std::string title() const;
  /// Returns the headings of the options: first what is required, last what all commands have.
  [[nodiscard]] std::vector<std::string> groups() const;
};

/// Returns the text with the letters a to z in capitals.
[[nodiscard]] std::string in_capitals(std::string text);

/// Describes a command by its declared options; those without effect are left out.
[[nodiscard]] HelpCommand help_of(const CLI::App& command);
/// Describes all commands; behind each stand its other names, which have the same options.
[[nodiscard]] std::vector<HelpCommand> help_of_commands(const CLI::App& app);

/// Returns a command line in lines of so many columns that a shell takes for one.
[[nodiscard]] std::string shell_lines(const std::string& line, std::size_t width);

/// Returns the columns that lines of help may fill: COLUMNS, or the terminal's width, or 100.
[[nodiscard]] std::size_t help_width();

/// Returns the help of a command, and of the program with its list of commands, in lines of at most so many columns.
[[nodiscard]] std::string command_text(const CLI::App& command, std::size_t width);
[[nodiscard]] std::string program_text(const CLI::App& app, std::size_t width);

}  // namespace myoid::program
