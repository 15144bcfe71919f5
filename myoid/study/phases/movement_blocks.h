#pragma once

#include <limits>
#include <vector>

#include "myoid/study/phases/phases.h"

namespace myoid::study {

/// Samples first .. last-1 of a trial in which the joint stands still, or moves.
struct TrialStretch {
  Eigen::Index first = 0, last = 0;
  bool still = false;
};

/// Stretches of standing still and of movement, in turn: still where the root mean square of the
/// rate over 1 s is below `kStill_radps`; a stop shorter than `kShortest_s` is part of the movement.
[[nodiscard]] std::vector<TrialStretch> still_and_moving(const PhaseSignals& signals);

/// The unit of the search: whole cycles of a movement, or a window of fixed length where the joint stands still.
struct Block {
  Eigen::Index first = 0, last = 0;  ///< Samples first .. last-1.
  /// ln of measured per predicted torque, by regression through the origin; NaN if not positive.
  double gain = std::numeric_limits<double>::quiet_NaN();
  /// Mean over channels and windows of ln(median frequency / the channel's median).
  double frequency = std::numeric_limits<double>::quiet_NaN();
  double speed = 0.0;   ///< Root mean square, at least `kStill_radps`.
  double torque = 0.0;  ///< Root mean square.
};

/// Blocks of `kBlock_s` or more, one after another from the beginning of the stretch. A block ends where the joint
/// turns at the lower end of its cycle; where it does not within twice `kBlock_s`, a block has that length.
[[nodiscard]] std::vector<Block> blocks_of(const PhaseSignals& signals, const TrialStretch& stretch);

/// Returns the standard deviation of the mean of `batch` neighbors times sqrt(batch): one block's
/// contribution to a mean, with the correlation between neighbors (batch means). Second differences
/// of the batch means exclude a level or a slope. NaN with fewer than 4 batches.
[[nodiscard]] double long_run_sd(const Eigen::VectorXd& x, Eigen::Index batch);

}  // namespace myoid::study
