#pragma once

#include <filesystem>

#include "myoid/commands/identify_options.h"
#include "myoid/identify_files/muscles_csv.h"
#include "myoid/study/study.h"

namespace myoid::commands {

/// Returns the study that the files and choices of `identify` are: without a model, each trial with given stages, the
/// muscles of muscles.csv as [[muscle]] and [[parameter]]. Notes go to `remarks`. Throws InvalidInput if a kind of
/// files does not match the number of trials.
[[nodiscard]] Study identify_study(const IdentifyOptions& options, const MuscleTable& table, Remarks& remarks);

/// Returns the study with its paths relative to the folder, for a study.toml there.
[[nodiscard]] Study seen_from(const std::filesystem::path& folder, Study study);

}  // namespace myoid::commands
