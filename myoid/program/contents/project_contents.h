#pragma once

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

namespace myoid::program {

/// Describes a calibration of another program (a folder, its set-up, or a subject) for people and programs: dialect,
/// files, law, degrees of freedom, trials, how many numbers were calibrated and lie on a bound, muscles without EMG.
/// The result is empty for any other path. Throws as `opensim::read_project`.
[[nodiscard]] std::optional<nlohmann::ordered_json> project_contents(const std::filesystem::path& path);

}  // namespace myoid::program
