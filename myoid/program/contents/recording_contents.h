#pragma once

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

namespace myoid::program {

/// Describes a recording or table for people and programs: kind, times, markers, channels with units, least and
/// greatest values and gaps, events, and the repairs of its reader. The result is empty unless the ending of the name
/// is a recording's (`is_recording`). A key is left out where the file has nothing for it: an empty series has no
/// start, and a single sample no rate. Throws ReadError if the file cannot be read, except for a .csv that is a table
/// without a clock, whose columns are named.
[[nodiscard]] std::optional<nlohmann::ordered_json> recording_contents(const std::filesystem::path& path);

}  // namespace myoid::program
