#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/kinematics/path_surrogate.h"

namespace myoid::body {

/// Returns the SHA-256 of the model's text, of the way in which paths are computed and of the
/// options of the fit. Any other text has another key, even with equal numbers.
[[nodiscard]] std::string surrogate_key(std::string_view model_text,
                                        const body::Compat& compat,
                                        const body::SurrogateOptions& options);

/// Writes surrogates as JSON, numbers with all their digits, coordinates by name.
void write_surrogates(const std::filesystem::path& path,
                      const body::BodyModel& model,
                      const std::string& key,
                      const std::vector<body::PathSurrogate>& surrogates);

/// Reads the surrogates of a file; empty for a missing file or another key. Throws ReadError if the
/// file holds no surrogates or contradicts the model whose key it has.
[[nodiscard]] std::optional<std::vector<body::PathSurrogate>> read_surrogates(const std::filesystem::path& path,
                                                                              const body::BodyModel& model,
                                                                              const std::string& key);

}  // namespace myoid::body
