#pragma once

#include <filesystem>
#include <string>

#include "myoid/ground/core/units.h"
#include "myoid/recording/series_file.h"

namespace myoid::recording {

/// Throws ReadError for a column in another unit than `expected`. A column without a unit is taken to be in it; a share
/// or percentage that is written is another unit.
void require_unit(const std::filesystem::path& path, const SeriesFile& file, Eigen::Index column, Unit expected);

/// Throws ReadError if a column is called `name` but for words in brackets that are no unit: "knee_moment [Nm/kg]".
void require_known_unit(const std::filesystem::path& path, const SeriesFile& file, const std::string& name);

/// Returns the factor from the unit that is written for a column to SI; 1 where none is.
[[nodiscard]] double written_factor(const SeriesFile& file, Eigen::Index column);

}  // namespace myoid::recording
