#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Rate up to which data without noise are fitted. Files hold few digits, so that more samples carry more information.
inline constexpr double kNoiseFreeRate_hz = 200.0;

/// Selects about `count` samples of the calibration trials, or all if there are fewer; at least
/// about 10 of each trial. The steps between them are irregular, so that no period of a movement is
/// a multiple of them. Other trials stay unchanged.
[[nodiscard]] StudyData few_samples(const StudyData& data, Eigen::Index count);

/// Plain least squares of data without noise: the z within the bounds that minimize
///
///   C(z) = 1/2 sum_i (T^_i(z) - T_i)^2
///
/// over the samples of the calibration trials, up to kNoiseFreeRate_hz, without weights, priors, gains and low-pass;
/// the envelopes are the drives. Levenberg-Marquardt runs from 12 starts, the given one and points near it at several
/// EMG delays, on 500 samples or 10 for each unknown, then once on all samples from a point that meets these few.
/// Returns the result if the sum of squared residuals is at most 1e-12 of the data's, else nothing: then the data have
/// noise, or do not follow the model. Both readings of a number are equal. The covariance is s^2 (J'J)^-1
/// (ground/math/covariance.h). Throws InvalidInput for data that do not fit together.
[[nodiscard]] std::optional<IdentificationResult> fit_exactly(const StudyData& data, const EstimatorOptions& options);

/// Returns the first exact fit of the data without nuisances (nuisances.h): with the v_max of `free_speeds` held; with
/// this v_max as an unknown; with the EMG's exponents. Empty if none is exact.
[[nodiscard]] std::optional<IdentificationResult> exact_fit(const StudyData& data, const EstimatorOptions& options);

}  // namespace myoid::fit
