#pragma once

#include <vector>

#include "myoid/study/phases/movement_blocks.h"
#include "myoid/study/phases/phases.h"

namespace myoid::study {

/// A phase of movement, in blocks.
struct BlockPhase {
  std::size_t first = 0, last = 0;
  Phase phase;
};

/// Divides the blocks of one trial's movement into regular, warm-up, fatigued and changed phases, in order. Each
/// segment between two changes is compared with the regular one (block_segments.h), the beginning with the effort later
/// on (warm_up.h). Empty with fewer than 8 blocks, or where torque per EMG is not known. Times are the caller's.
[[nodiscard]] std::vector<BlockPhase> moving_phases(const std::vector<Block>& blocks);

}  // namespace myoid::study
