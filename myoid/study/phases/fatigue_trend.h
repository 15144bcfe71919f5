#pragma once

#include <optional>
#include <vector>

#include "myoid/study/phases/movement_blocks.h"

namespace myoid::study {

/// Fewer blocks are not searched.
inline constexpr std::size_t kFewestBlocks = 8;

/// The end of a row of blocks, in which the muscles are tired.
struct FatigueTrend {
  std::size_t first = 0;            ///< The first tired block.
  double gain = 1.0;                ///< Torque per EMG of the tired blocks, over that of the fresh ones.
  std::optional<double> frequency;  ///< Median frequency, likewise; empty: not known.
};

/// Returns the blocks of the usual movement: speed and torque differ from the medians by less than `kAlike`.
[[nodiscard]] std::vector<std::size_t> usual_blocks(const std::vector<Block>& blocks);

/// Searches the usual blocks for torque per EMG and frequency that fall together and stay low,
///
///   y_k = a - b min(max(0, k - c), w),   w = 1 (a step), 2, 4, ... blocks (a ramp),
///
/// the c and w with the least sum of squares over both. Each fall at the last block is at least `kGainChange` or
/// `kFrequencyFall`, and `kSignificance` standard errors. The noise of a block is the greatest of its spread about
/// neighbors, that about the trend, and that of means of 4 blocks. Fatigue begins where the trend of the torque has
/// lost `kGainChange`. Where more than a fifth of the frequencies are not known, the torque alone speaks. Empty with
/// fewer than kFewestBlocks usual blocks, or where torque per EMG is not known.
[[nodiscard]] std::optional<FatigueTrend> find_fatigue(const std::vector<Block>& blocks);

}  // namespace myoid::study
