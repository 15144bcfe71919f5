#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/kinematics/path_surrogate.h"

namespace myoid::kinematics {

/// What surrogates belong to: SHA-256 of the model's text, of the way its paths are computed and of
/// the options of the fit. Another text, even of the same numbers, has another key.
[[nodiscard]] std::string surrogate_key(std::string_view model_text,
                                        const model::Compat& compat,
                                        const kinematics::SurrogateOptions& options);

/// Writes surrogates as JSON, numbers with all their digits, coordinates by name.
void write_surrogates(const std::filesystem::path& path,
                      const model::BodyModel& model,
                      const std::string& key,
                      const std::vector<kinematics::PathSurrogate>& surrogates);

/// The surrogates of a file; empty if there is no such file or it belongs to another key. Throws
/// ReadError if the file is not one of surrogates, or does not fit the model whose key it has.
[[nodiscard]] std::optional<std::vector<kinematics::PathSurrogate>> read_surrogates(
    const std::filesystem::path& path, const model::BodyModel& model, const std::string& key);

}  // namespace myoid::kinematics
