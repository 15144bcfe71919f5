#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace myoid::fit {

/// A torque's prediction against its measurement, as sums over the samples; the sums of several
/// trials make a joint score.
struct Score {
  double n = 0.0;                 ///< Samples.
  double sse = 0.0;               ///< Sum of the squared errors [N^2 m^2].
  double sst = 0.0;               ///< Sum of the squares of the torque about its mean; 0 for a constant torque.
  double mean_nm = 0.0;           ///< Mean of the measured torque.
  double range_nm = 0.0;          ///< Range of the measured torque: largest minus smallest.
  double error_spread_nm2 = 0.0;  ///< Sum of the squares of the error about its mean.

  [[nodiscard]] double rmse_nm() const;      ///< sqrt(SSE / n); 0 without samples.
  [[nodiscard]] double nrmse_range() const;  ///< RMSE over the range of the measured torque.
  /// RMSE over the standard deviation of the measured torque.
  [[nodiscard]] double nrmse_sd() const;
  /// Returns 1 - SSE/SST; negative: worse than the trial's own mean; 0 for a constant torque.
  [[nodiscard]] double r2() const;
  [[nodiscard]] double vaf() const;  ///< 1 - var(error)/var(torque)
};
[[nodiscard]] Score score(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted);

/// The predicted fiber lengths of one muscle against measured ones, as sums.
struct FiberScore {
  std::string muscle;
  double n = 0.0;       ///< Samples with a measurement.
  double sse_m2 = 0.0;  ///< Sum of the squared errors.

  [[nodiscard]] double rms_m() const;
};

/// Scores of all muscles with measured fiber lengths.
struct FiberScores {
  std::vector<FiberScore> fibers;

  /// Adds the sums of other trials of the same study.
  void add(const FiberScores& more);
};

/// Returns R2 in at most 8 characters: "0.931", "-150", "-1.5e+04".
[[nodiscard]] std::string r2_text(double r2);

/// Returns a torque without the frequencies above `cutoff_hz` (-3 dB, two passes of second order, no delay), on an even
/// clock. The torque stays unchanged if the clock is too slow or too short, or the cut-off is 0.
[[nodiscard]] Eigen::VectorXd below(const Eigen::VectorXd& time_s, const Eigen::VectorXd& torque_nm, double cutoff_hz);

}  // namespace myoid::fit
