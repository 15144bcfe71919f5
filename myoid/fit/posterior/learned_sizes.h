#pragma once

#include <Eigen/Core>

#include "myoid/fit/posterior/exploration.h"

namespace myoid::fit {

/// The sizes y of the errors are learned, and are not known exactly. A part of a number's variance that is proportional
/// to y^2 has the expectation over y, E[y^2], in place of the value at the mode. So a width follows from Fisher's
/// information at sizes y' with y'^2 = E[y^2] (law of total variance).
///
/// The expectation is over the density of the sizes alone, integrated over the unknowns z and the unseen x, in which
/// the torque is linear about the mode: with information G of both, each over its believed spread, prior precision P =
/// diag(P_z, 1), gradient g of both at the mode's z and x = 0, and D = diag(1, y / y_mode),
///
///   ln p(y) = g' D (P + D G D)^-1 D g / 2 - ln |P + D G D| / 2 + ln y - y^2 / 2,
///
/// y over the believed size, half normal by its prior.
///
/// At the joint mode of z and y the sizes are too small: the muscles' numbers have taken the part of each error that
/// looks like theirs (restricted maximum likelihood; Patterson & Thompson 1971).
struct LearnedSizes {
  NoiseValues noise;      ///< Hyperparameters with the sizes y'.
  Eigen::VectorXd wider;  ///< Per unknown: standard deviation at y' over that at the mode; 1 or more.
};

/// Returns the sizes about a mode.
[[nodiscard]] LearnedSizes learned_sizes(const Candidate& best);

/// Stretches the draws of each unknown about their weighted mean by `wider`, on the unbounded scale (density.h).
void stretch(const Eigen::VectorXd& wider, const ParameterMap& map, Sample& drawn);

}  // namespace myoid::fit
