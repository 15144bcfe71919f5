#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace myoid::program {

/// A command line that is wrong whatever the files hold; ends the program with `kWrongCommandLine`.
class WrongCommandLine : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the name that `word` may stand for: the only one that begins with it, or one a slip of the pen away.
[[nodiscard]] std::optional<std::string> meant(std::string_view word, const std::vector<std::string>& names);

/// Returns a sentence on the first option that stands without its value: last, or with another option behind it.
/// Empty: there is none. `words` are those behind the command's name.
[[nodiscard]] std::string missing_value(const CLI::App& command, const std::vector<std::string>& words);

/// Returns a sentence on what is wrong with a command line that CLI11 refused with this error.
[[nodiscard]] std::string wrong_line(const CLI::App& command, const CLI::ParseError& error);

}  // namespace myoid::program
