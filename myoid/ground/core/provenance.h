#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::inline ground {

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

/// Returns the provenance for results that leave the laboratory: each absolute path of inputs, command and options is
/// written from `folder`, or as the name of the file alone where the two share no folder.
[[nodiscard]] Provenance without_places(Provenance provenance, const std::filesystem::path& folder);

}  // namespace myoid::inline ground
