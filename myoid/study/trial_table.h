#pragma once

#include <filesystem>

#include "myoid/files/toml_table.h"
#include "myoid/study/study.h"

namespace myoid {

/// One [[trial]] of a study; paths are resolved against `folder`. Throws ReadError with the line
/// for a name that is no folder's, files that exclude each other or are missing for the trial's
/// use, and times in the wrong order.
[[nodiscard]] TrialSpec read_trial(recording::TomlTable table, const std::filesystem::path& folder);

/// [sync] of a study or of one of its trials. Throws ReadError with the line unless it says in one
/// way alone (a number, "estimate", a pair of triggers) how the clocks stand.
[[nodiscard]] SyncSpec read_sync(recording::TomlTable table, const std::filesystem::path& folder);

}  // namespace myoid
