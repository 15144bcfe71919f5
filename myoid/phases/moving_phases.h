#pragma once

#include <vector>

#include "myoid/phases/movement_blocks.h"
#include "myoid/phases/phases.h"

namespace myoid {

/// A phase of movement, in blocks.
struct BlockPhase {
  std::size_t first = 0, last = 0;
  Phase phase;
};

/// Regular, warm-up, fatigue and what is neither, of blocks of one trial's movement in their order:
/// each segment between two changes against the regular one (block_segments.h), the beginning
/// against the effort later on (warm_up.h). Empty with fewer than 8 blocks, or where torque per EMG
/// is not known. Times are the caller's.
[[nodiscard]] std::vector<BlockPhase> moving_phases(const std::vector<Block>& blocks,
                                                    const PhaseOptions& options);

}  // namespace myoid
