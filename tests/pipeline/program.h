#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace myoid::test {

/// What a finished program left behind.
struct Finished {
  int exit_code = -1;  ///< 128 + signal if it was killed.
  std::string out;     ///< stdout
  std::string err;     ///< stderr
};

/// Runs the built `myoid` with these arguments, stdin closed. `interrupt_after_s` > 0 sends SIGINT
/// then. With `stdout_to`, stdout goes there and is not read back.
[[nodiscard]] Finished myoid(const std::vector<std::string>& arguments,
                             double interrupt_after_s = 0.0,
                             const std::string& stdout_to = "");

[[nodiscard]] std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

/// Replaces the only occurrence of `from` in a file; throws if there is none.
void replace_in(const std::filesystem::path& file, const std::string& from, const std::string& to);

/// Rows of a .csv file, each a map from the header's names. Quoted cells may hold commas.
using Row = std::map<std::string, std::string>;
[[nodiscard]] std::vector<Row> read_rows(const std::filesystem::path& file);

}  // namespace myoid::test
