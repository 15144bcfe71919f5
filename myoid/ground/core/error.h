#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace myoid::inline ground {

/// The caller gave an unusable value, shape, unit or name. The message has the value found, the
/// expectation and the remedy.
class InvalidInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// The message is a format and its arguments, as of `fmt::format`.
  template <typename First, typename... Rest>
  InvalidInput(fmt::format_string<First, Rest...> message, First&& first, Rest&&... rest)
      : InvalidInput(fmt::format(message, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
};

/// A file cannot be read as its kind. `what()` begins with the path and, if there is one, the line:
/// "dir/file.trc:17: expected ..., found ...; remedy".
class ReadError : public InvalidInput {
 public:
  /// `line` counts from 1; 0 means the file as a whole.
  ReadError(std::filesystem::path path, std::size_t line, const std::string& message)
      : InvalidInput(line == 0 ? fmt::format("{}: {}", path.string(), message)
                               : fmt::format("{}:{}: {}", path.string(), line, message)),
        path_(std::move(path)),
        line_(line) {}
  template <typename First, typename... Rest>
  ReadError(std::filesystem::path path,
            std::size_t line,
            fmt::format_string<First, Rest...> message,
            First&& first,
            Rest&&... rest)
      : ReadError(
            std::move(path), line, fmt::format(message, std::forward<First>(first), std::forward<Rest>(rest)...)) {}

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  std::filesystem::path path_;
  std::size_t line_;
};

/// A model is inconsistent or needs something that is not supported.
class ModelError : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// The user asked to stop (Ctrl-C); finished results stay usable.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace myoid::inline ground
