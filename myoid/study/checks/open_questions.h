#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "myoid/ground/core/remark.h"

namespace myoid::study {

/// Returns a warning with every question that `init` left in the text of a study and nobody answered
/// (`open_questions_in`). Empty: none is left.
[[nodiscard]] std::optional<Remark> open_questions(std::string_view text, const std::filesystem::path& file);

}  // namespace myoid::study
