#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "myoid/lab/virtual_person/protocol.h"

namespace myoid::lab {

/// The word for the protocol that the program carries, wherever the name of a protocol's file is expected.
inline constexpr std::string_view kDemoProtocol = "demo";

/// Returns the text of examples/demo/protocol.toml.
[[nodiscard]] std::string_view demo_protocol_text();

/// Returns the text of the file, or of the program's own protocol if the name is `demo`; `./demo` is a file. Throws
/// InvalidInput.
[[nodiscard]] std::string protocol_text(const std::filesystem::path& name);

/// Reads `protocol_text`. Throws as `read_protocol` does.
[[nodiscard]] Protocol protocol_named(const std::filesystem::path& name, std::optional<Level> level = std::nullopt);

}  // namespace myoid::lab
