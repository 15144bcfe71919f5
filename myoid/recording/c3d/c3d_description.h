#pragma once

#include <cstddef>
#include <vector>

#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::recording {

/// Returns the groups of `file` with all parameters that describe its data: USED, RATE, LABELS, UNITS, ... of POINT,
/// ANALOG, FORCE_PLATFORM and EVENT. Counts beyond 16 bits go to POINT:LONG_FRAMES and TRIAL:ACTUAL_START_FIELD, names
/// beyond the 255th to LABELS2 and so on. `scale` becomes POINT:SCALE; POINT:DATA_START stays 0 until `set_data_start`.
/// Throws InvalidInput if the format cannot hold a value.
[[nodiscard]] std::vector<C3dGroup> c3d_description(const C3dFile& file, double scale);

/// Sets the block at which the data begin.
void set_data_start(std::vector<C3dGroup>& groups, std::size_t block);

}  // namespace myoid::recording
