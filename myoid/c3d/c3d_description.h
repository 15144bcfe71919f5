#pragma once

#include <cstddef>
#include <vector>

#include "myoid/c3d/c3d_file.h"

namespace myoid::recording {

/// The groups of `file` with everything in them that describes its data as they are written: USED,
/// RATE, LABELS, UNITS, ... of POINT, ANALOG, FORCE_PLATFORM and EVENT; counts beyond 16 bits in
/// POINT:LONG_FRAMES and TRIAL:ACTUAL_START_FIELD, names beyond the 255th in LABELS2 and so on.
/// `scale` becomes POINT:SCALE; POINT:DATA_START is 0 yet. Throws InvalidInput if the format cannot
/// hold something.
[[nodiscard]] std::vector<C3dGroup> c3d_description(const C3dFile& file, double scale);

/// The block at which the data begin.
void set_data_start(std::vector<C3dGroup>& groups, std::size_t block);

}  // namespace myoid::recording
