#pragma once

#include <Eigen/Core>

#include "myoid/fit/posterior/exploration.h"

namespace myoid::fit {

/// The sizes y of the errors are learned, and are not known exactly. A part of a number's variance that is proportional
/// to y^2 has the expectation over y, E[y^2], in place of the value at the mode. So a width follows from Fisher's
/// information at sizes y' with y'^2 = E[y^2] over the draws (law of total variance; the change of the mean with y is
/// in the draws already).
struct LearnedSizes {
  NoiseValues noise;      ///< Hyperparameters with the sizes y'.
  Eigen::VectorXd wider;  ///< Per unknown: standard deviation at y' over that at the mode; 1 or more.
};

/// Returns the sizes of the heaviest mode's draws.
[[nodiscard]] LearnedSizes learned_sizes(const Candidate& best, const Sample& drawn);

/// Stretches the draws of each unknown about their weighted mean by `wider`, on the unbounded scale (density.h).
void stretch(const Eigen::VectorXd& wider, const ParameterMap& map, Sample& drawn);

}  // namespace myoid::fit
