#pragma once

#include <optional>

#include "myoid/identification/estimator.h"

namespace myoid::identification {

/// Data without noise are fitted at up to this rate: files hold a limited number of digits, and
/// more samples hold more of them.
inline constexpr double kNoiseFreeRate_hz = 200.0;

/// About `count` samples of the calibration trials, or all where there are no more; about 10 at
/// least of each. Steps between them are irregular, so that no period of a movement is a multiple
/// of them. Other trials stay as they are.
[[nodiscard]] StudyData few_samples(const StudyData& data, Eigen::Index count);

/// The minimum of `whole` that meets data without noise: 12 searches from the start and from points
/// moved about it, at several EMG delays, on 500 samples or 10 for each unknown, and then one
/// search on all samples from the point that meets these few. A fit meets data if the sum of the
/// squared residuals is at most 1e-12 of the data's. Empty: none was found. `whole` is the
/// estimator of `data` without priors, weights and low-pass.
[[nodiscard]] std::optional<Estimator::Solution> noise_free_solution(const StudyData& data,
                                                                     const Estimator& whole);

}  // namespace myoid::identification
