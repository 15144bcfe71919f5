#pragma once

#include <filesystem>
#include <vector>

#include "tests/damage/kinds.h"

namespace myoid::damage {

/// One good table of markers or channels of every maker's layout that the readers know, with what
/// must stand beside it in `folder`.
[[nodiscard]] std::vector<Kind> good_tables(const std::filesystem::path& folder);

}  // namespace myoid::damage
