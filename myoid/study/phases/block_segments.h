#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "myoid/study/phases/movement_blocks.h"
#include "myoid/study/phases/phases.h"

namespace myoid::study {

/// Blocks in a mean by which the noise is measured: some 8 s, longer than the correlation of a
/// person's variation from cycle to cycle. A warm-up or a fresh phase has at least as many.
inline constexpr Eigen::Index kBatch = 4;

/// Blocks first .. last-1 between two changes, and how they compare with others.
struct Segment {
  std::size_t first = 0, last = 0;
  /// Means of logarithms; the frequency is NaN if it is not known.
  double gain = 0.0, frequency = std::numeric_limits<double>::quiet_NaN();
  double speed = 0.0, torque = 0.0;
  [[nodiscard]] double count() const { return static_cast<double>(last - first); }
};

/// The blocks at which torque per EMG and frequency change.
struct BlockChanges {
  Eigen::VectorXd gain, frequency;  ///< Per block; the latter empty if not known.
  std::vector<Segment> segments;
  double gain_sd = 0.0, frequency_sd = 0.0;  ///< For one block.
};

/// Searches both together for the blocks at which their means change. The noise of one block is its
/// spread about its neighbors, or as it counts in a mean of `kBatch`, whichever is more; a second
/// search takes the noise about the means of the segments that the first one finds. Where more
/// than a fifth of the frequencies are not known, none is used. Gains must be finite.
[[nodiscard]] BlockChanges find_changes(const std::vector<Block>& blocks);

/// Returns true if two stretches are of one movement: speed and torque differ by less than `factor`.
[[nodiscard]] bool alike(double speed, double torque, double other_speed, double other_torque, double factor);

/// Chooses the longest segment. If torque per EMG and frequency were both higher in earlier segments, the muscles tired
/// in the longest one: the earlier segment with the most torque per EMG is chosen.
[[nodiscard]] std::size_t regular_segment(const BlockChanges& changes);

}  // namespace myoid::study
