#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "myoid/results/cohort/manifest.h"

namespace myoid::results {

/// Fills a template: {name}, {label} and {COLUMN} for each further column of the manifest become
/// the person's own. `file` is the template's place, for messages. Throws ReadError with the line
/// for a word in braces that no column has, and for a column without a value for this person.
[[nodiscard]] std::string filled_study(std::string_view text, const std::filesystem::path& file, const Person& person);

/// Returns the study file of a person: the one that the manifest names, or, if that file is a
/// template, `study.toml` in `folder`, which this function writes where its text differs. Paths in
/// a template are relative to the template. Throws ReadError as `filled_study` and `read_study` do.
[[nodiscard]] std::filesystem::path person_study(const Person& person, const std::filesystem::path& folder);

}  // namespace myoid::results
