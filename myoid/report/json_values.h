#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "myoid/core/provenance.h"

namespace myoid::report {

/// A number as JSON; null where it is absent or not finite, which JSON cannot write.
[[nodiscard]] nlohmann::ordered_json number_or_null(const std::optional<double>& value);

/// Renders JSON for programs, indented by two. Never throws: bytes that are no UTF-8, as names of
/// files and channels may hold, become U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

/// Program, version, command, inputs with their SHA-256, and options.
[[nodiscard]] nlohmann::ordered_json provenance_json(const Provenance& provenance);

}  // namespace myoid::report
