#pragma once

#include <filesystem>

#include "myoid/program/commands/identify_options.h"
#include "myoid/run/identify_files/muscles_csv.h"
#include "myoid/study/study.h"

namespace myoid::program {

/// Returns the study that the files and choices of `identify` are: without a model, each trial with given stages, the
/// muscles of muscles.csv as [[muscle]] and [[parameter]]. Notes go to `remarks`. Throws InvalidInput if a kind of
/// files does not match the number of trials.
[[nodiscard]] study::Study identify_study(const IdentifyOptions& options,
                                          const run::MuscleTable& table,
                                          Remarks& remarks);

/// Returns a project's study (results/review/project_study.h) with the choices of the fit and the times of `identify`.
[[nodiscard]] study::Study with_choices(study::Study study, const IdentifyOptions& options);

/// Returns the study with its paths relative to the folder, for a study.toml there.
[[nodiscard]] study::Study seen_from(const std::filesystem::path& folder, study::Study study);

}  // namespace myoid::program
