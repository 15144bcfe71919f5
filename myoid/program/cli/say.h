#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace myoid::program {

/// Everything that the program prints goes through these functions: names, labels and paths are other people's, and
/// their control characters must not steer the terminal (`terminal_text`).
void say_text(std::FILE* stream, std::string_view text);

/// Prints JSON or TOML. Control characters are escaped; no word is cut short.
void say_whole(std::string_view text);

template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  say_text(stdout, fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
void say_error(fmt::format_string<Args...> format, Args&&... args) {
  say_text(stderr, fmt::format(format, std::forward<Args>(args)...));
}

/// Returns a name as a column of a table has room for it.
[[nodiscard]] std::string in_column(std::string_view name);

}  // namespace myoid::program
