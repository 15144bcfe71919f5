#pragma once

#include <filesystem>
#include <vector>

#include "myoid/recording/recording.h"

#include "tests/damage/kinds.h"

namespace myoid::damage {

/// Rows of every table that is made.
inline constexpr int kRows = 40;

/// Adds the sentences of what a reader repaired.
void add_notes(const std::vector<Repair>& repairs, Content& content);

/// Channels of all clocks of a file, with its events.
[[nodiscard]] Content read_channels(const std::filesystem::path& path);

/// One good table of markers or channels of every maker's layout that the readers know, with what
/// must stand beside it in `folder`.
[[nodiscard]] std::vector<Kind> good_tables(const std::filesystem::path& folder);

}  // namespace myoid::damage
