#pragma once

#include <string>
#include <vector>

#include "myoid/identification/torque.h"

namespace myoid::identification {

/// How well a torque is predicted that took no part in the fit.
struct Score {
  double rmse_nm = 0.0;
  double nrmse_range = 0.0;  ///< RMSE over the range of the measured torque.
  double r2 = 0.0;           ///< 1 - SSE/SST; negative: worse than the trial's own mean.
  double vaf = 0.0;          ///< 1 - var(error)/var(torque)
};
[[nodiscard]] Score score(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted);

/// One trial left out.
struct Fold {
  std::string trial;
  Score identified;   ///< Fitted on the other trials.
  Score literature;   ///< Literature parameters with the one gain that fits the other trials best.
  Score constant;     ///< Mean torque of the other trials.
  double gain = 1.0;  ///< That gain.
  Eigen::VectorXd time_s, measured_nm, predicted_nm, literature_nm;
};

/// Leave-one-trial-out over the calibration trials, folds in parallel. At least two trials are
/// needed; empty otherwise.
[[nodiscard]] std::vector<Fold> cross_validate(const StudyData& data,
                                               const TorqueOptions& options = {});

}  // namespace myoid::identification
