#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// Corrects the unit of the moments, or of the point that type 1 measures, by the center of pressure about the
/// transducer under load, with a note:
///
/// - at least 95 % of the samples are outside the plate, half of them ten times its size away, and 95 % are inside
///   after division by 1,000: the numbers are N mm (mm);
/// - 99 % are within a five-hundredth of its size, and multiplied by 1,000 95 % are inside, half of them 20 mm or more
///   away: the numbers are N m (m).
///
/// A moment about the normal of the same unit follows. One of another unit is N mm if it exceeds force times the
/// plate's size in 95 % of the samples.
void mend_moment_unit(PlateSetup& setup, const Eigen::MatrixXd& channel_values, std::vector<Repair>& repairs);

}  // namespace myoid::recording
