#pragma once

#include <filesystem>

#include "myoid/run/study_result.h"

namespace myoid::results {

/// Writes the study's model with the numbers that are `identified`, F_max only if EMG is relative to an MVC. Writes no
/// model if the motion failed its gates or no number changes.
void write_identified_model(const run::StudyResult& result, const std::filesystem::path& folder);

}  // namespace myoid::results
