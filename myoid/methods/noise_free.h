#pragma once

#include <optional>

#include "myoid/identification/estimator.h"

namespace myoid::identification {

/// Rate up to which data without noise are fitted. Files hold few digits, so that more samples carry more information.
inline constexpr double kNoiseFreeRate_hz = 200.0;

/// Selects about `count` samples of the calibration trials, or all if there are fewer; at least
/// about 10 of each trial. The steps between them are irregular, so that no period of a movement is
/// a multiple of them. Other trials stay unchanged.
[[nodiscard]] StudyData few_samples(const StudyData& data, Eigen::Index count);

/// Returns the minimum of `whole` that meets data without noise; empty if none is found. Runs 12 searches from the
/// start and from points near it, at several EMG delays, on 500 samples or 10 for each unknown, then one search on all
/// samples from a point that meets these few. A fit meets data if the sum of the squared residuals is at most 1e-12 of
/// the data's. `whole` is the estimator of `data` without priors, weights and low-pass.
[[nodiscard]] std::optional<Estimator::Solution> noise_free_solution(const StudyData& data, const Estimator& whole);

}  // namespace myoid::identification
