#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::identification {

/// Two noise levels of a joint: of the torque, and of the EMG that multiplies the muscles' forces.
struct NoiseLevel {
  double torque_sd_nm = 1.0;
  double emg_cv = 0.0;      ///< Of a channel: root mean square over the channels.
  double emg_factor = 0.0;  ///< By which every channel's expected relative sd is multiplied; where
                            ///< nothing is expected, 1 is, and this is `emg_cv`.
  /// The part of emg_factor^2 that is noise of the EMG. Where the EMG's bandwidth makes a level
  /// expected, residuals beyond it that go with the muscles' torques are the model's error.
  double emg_share = 1.0;
  double log_variance_sd = 0.0;  ///< Of ln(emg_share emg_factor^2): how well that is known.
};

/// Variances a and b of s^2 = a + b power where b is expected to be 1 (ln sqrt(b) = 0 +- 0.3): most
/// likely for residuals that are normal, each counting `share`. Torque is never without noise: a is
/// at least 5 % of the mean square.
[[nodiscard]] NoiseLevel fit_known_noise(const Eigen::ArrayXd& squared,
                                         const Eigen::ArrayXd& power,
                                         double share);

/// Both variances by weighted regression of the squared residuals on [1, EMG power], neither
/// negative.
[[nodiscard]] NoiseLevel fit_unknown_noise(const Eigen::ArrayXd& squared,
                                           const Eigen::ArrayXd& power);

/// Averages twice over 2 `half` + 1 samples, fewer at the ends, within each of consecutive pieces.
[[nodiscard]] Eigen::VectorXd averaged_twice(Eigen::VectorXd power,
                                             const std::vector<Eigen::Index>& piece_lengths,
                                             Eigen::Index half);

}  // namespace myoid::identification
