#pragma once

#include <optional>

#include <Eigen/Core>

#include "myoid/recording/c3d/c3d_file.h"
#include "myoid/recording/recorded_trial.h"

namespace myoid::recording {

/// Analog samples [first, first + count) from the start of the file.
struct ZeroSamples {
  Eigen::Index first = 0, count = 0;
};

/// Returns the samples in which FORCE_PLATFORM:ZERO says that a plate (from 0) is empty. ZERO holds the first and the
/// last frame, counted from 1 at the start of the file, for all plates or a pair for each; 0 as the first frame means
/// 1. Numbers past the end are taken on the clock of the header, as a cut file has them. Empty for 0 0, for a last
/// frame before the first (1 0), and, with a note, for frames that the file does not have. Source: the C3D user guide.
[[nodiscard]] std::optional<ZeroSamples> zero_samples(const C3dFile& file,
                                                      Eigen::Index frames,
                                                      std::size_t plate,
                                                      std::vector<Repair>& repairs);

/// Fills `baseline` of each plate: the mean of each force or moment channel over the samples of ZERO. A baseline of
/// `kLeastForce_n` / 2 or more is noted. Nothing is subtracted, with a note, where the plate is loaded in these
/// samples: its mean is above 30 N and
///
/// - the force changes there by more than 20 N and a quarter of its mean (standard deviation);
/// - or elsewhere the plate rests at 0 for 0.1 s;
/// - or no force has the other sign, and the plate unloads below the mean, by a tenth of the impulse above or more;
/// - or the force stays within 10 N of the mean all the time, and the markers are above the plate.
///
/// A plate whose force is the same in all samples has no baseline.
void find_baselines(const C3dFile& file, Eigen::Index frames, Recording& recording, std::vector<Repair>& repairs);

}  // namespace myoid::recording
