#pragma once

#include <Eigen/Core>

namespace myoid::recording {

/// True for rectified and smoothed EMG: the samples are never negative (except for a filter's swing
/// of 5 %) and go through their median less than `raw_hz` times a second.
[[nodiscard]] bool is_envelope(const Eigen::Ref<const Eigen::VectorXd>& samples, double rate_hz);

/// True for rectified EMG that was not smoothed: no sample is negative, and at least `rectified_share` of all lie below
/// a tenth of the median (of rectified Gaussian noise 5 %). Raw EMG on an offset keeps far from zero.
[[nodiscard]] bool is_rectified(const Eigen::Ref<const Eigen::VectorXd>& samples);

/// Returns the statistical bandwidth between 1.25 `highpass_hz` and 450 Hz over that of white noise, of high-passed
/// EMG; 0 for a rate without such a band.
[[nodiscard]] double flatness_of(const Eigen::VectorXd& samples, double rate_hz, double highpass_hz);

/// True for high-passed EMG [V] that is nothing but the noise of an amplifier: steady (`noise_rises`), weak (`noise_v`)
/// and white (`noise_flatness`).
[[nodiscard]] bool is_noise(const Eigen::VectorXd& samples, double rate_hz, double highpass_hz);

}  // namespace myoid::recording
