#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::identification {

/// Two noise levels of a joint: the torque's, and that of the EMG that multiplies the muscles' forces.
struct NoiseLevel {
  double torque_sd_nm = 1.0;
  /// A channel's coefficient of variation, root mean square over the channels.
  double emg_cv = 0.0;
  double emg_factor = 0.0;  ///< Factor on every channel's expected relative sd; equals `emg_cv`
                            ///< where no sd is expected.
  /// The part of emg_factor^2 that is noise of the EMG. Where the EMG's bandwidth gives an expected
  /// level, residuals beyond this level that vary with the muscles' torques are the model's error.
  double emg_share = 1.0;
  double log_variance_sd = 0.0;  ///< Spread of ln(emg_share emg_factor^2).
};

/// Fits the variances a and b of s^2 = a + b power where b is expected to be 1 (ln sqrt(b) = 0 +-
/// 0.3): the most likely ones for normal residuals, each of which counts `share`. Torque is never
/// without noise: a is at least 5 % of the mean square.
[[nodiscard]] NoiseLevel fit_known_noise(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& power, double share);

/// Fits both variances by weighted regression of the squared residuals on [1, EMG power]; neither is negative.
[[nodiscard]] NoiseLevel fit_unknown_noise(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& power);

/// Averages twice over 2 `half` + 1 samples, fewer at the ends, within each consecutive piece.
[[nodiscard]] Eigen::VectorXd averaged_twice(Eigen::VectorXd power,
                                             const std::vector<Eigen::Index>& piece_lengths,
                                             Eigen::Index half);

}  // namespace myoid::identification
