#pragma once

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

namespace myoid::pipeline {

/// What a recording or table holds, for people and programs: kind, times, channels with units,
/// least and greatest values and gaps, events, and what its reader mended. Of .trc, .mot, .sto,
/// .csv, .tsv, .txt, .emt, .c3d, .edf, .bdf and .anc; empty for other names. Throws ReadError if
/// the file cannot be read, except for a .csv that is a table without a clock, whose columns are
/// named.
[[nodiscard]] std::optional<nlohmann::ordered_json> recording_contents(
    const std::filesystem::path& path);

}  // namespace myoid::pipeline
