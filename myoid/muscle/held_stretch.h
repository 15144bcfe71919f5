#pragma once

#include <cstddef>
#include <vector>

#include "myoid/muscle/fit_isolated.h"

namespace myoid::muscle {

/// A stretch of an active muscle after which the muscle is held, still active. Muscles pull more after it than at the
/// same length without a stretch (residual force enhancement, Abbott & Aubert 1952); a Hill-type muscle does not.
struct HeldStretch {
  std::size_t recording = 0;
  double begin_s = 0.0, end_s = 0.0;  ///< Of the stretch.
  double rise_m = 0.0;                ///< Its size.
  double held_until_s = 0.0;
};

/// Finds each recording's first stretch of at least 0.03 l0 while the drive is above one half, after which the length
/// stays within 0.01 l0 for at least 0.5 s of drive.
[[nodiscard]] std::vector<HeldStretch> held_stretches(const std::vector<IsolatedRecording>& recordings,
                                                      double optimal_fiber_length_m);

/// Returns the recording's forces before the stretch.
[[nodiscard]] IsolatedRecording before(const HeldStretch& stretch, const IsolatedRecording& recording);

/// Returns the mean of the measured force minus the model's [N] over the last quarter of the hold; 0 if no force was
/// measured there.
[[nodiscard]] double force_enhancement_n(const HeldStretch& stretch,
                                         const IsolatedModel& model,
                                         const IsolatedRecording& recording);

}  // namespace myoid::muscle
