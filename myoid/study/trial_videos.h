#pragma once

#include <filesystem>

#include "myoid/study/study.h"

namespace myoid::study {

/// Sets the films of the trials that `choice` names, in place of the study's. Throws InvalidInput for a trial that the
/// study lacks, a repeated trial, a missing name in a study of several movements, and an offset without a film.
void set_videos(Study& study, const VideoChoice& choice);

/// Throws ReadError, naming trial and file, if a film of the study is missing.
void require_videos(const Study& study);

/// Reads a study and requires its films; `choice` replaces the study's own. Throws as `read_study`,
/// `set_videos` and `require_videos` do.
[[nodiscard]] Study read_filmed_study(const std::filesystem::path& file, const VideoChoice& choice);

}  // namespace myoid::study
