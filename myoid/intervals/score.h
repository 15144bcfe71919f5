#pragma once

#include <Eigen/Core>

namespace myoid::identification {

/// How well a torque is predicted.
struct Score {
  double rmse_nm = 0.0;
  double nrmse_range = 0.0;  ///< RMSE over the range of the measured torque.
  double nrmse_sd = 0.0;     ///< RMSE over its standard deviation.
  double r2 = 0.0;           ///< 1 - SSE/SST; negative: worse than the trial's own mean.
  double vaf = 0.0;          ///< 1 - var(error)/var(torque)
};
[[nodiscard]] Score score(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted);

/// 1 - SSE/SST; 0 if the reference is constant.
[[nodiscard]] double coefficient_of_determination(const Eigen::VectorXd& reference,
                                                  const Eigen::VectorXd& predicted);

/// A torque without what lies above `cutoff_hz` (-3 dB, two passes of second order, no delay), on
/// an even clock; as it is if the clock is too slow or too short for that, or the cut-off is 0.
[[nodiscard]] Eigen::VectorXd below(const Eigen::VectorXd& time_s,
                                    const Eigen::VectorXd& torque_nm,
                                    double cutoff_hz);

}  // namespace myoid::identification
