#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace myoid {

/// This program's version, "0.1.0".
[[nodiscard]] std::string_view version();

/// Returns the SHA-256 of a byte string, as 64 lower-case hexadecimal digits (FIPS 180-4).
[[nodiscard]] std::string sha256(std::string_view bytes);

struct InputFile {
  std::string path;    ///< As the user wrote the path.
  std::string sha256;  ///< Hash of the content.
};

/// Facts that make a result reproducible: the head of every result file.
struct Provenance {
  std::string program = "myoid";
  std::string version{myoid::version()};
  std::string command;            ///< The command line.
  std::vector<InputFile> inputs;  ///< Every file that was read.
  std::string options_json;       ///< The full options, defaults included.
};

}  // namespace myoid
