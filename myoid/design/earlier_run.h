#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/intervals/result.h"

namespace myoid {

/// What a finished run found (its parameters.json, method torque): what is known before the next
/// recording.
struct EarlierRun {
  std::vector<std::string> parameters;  ///< "BIC.max_isometric_force"
  Eigen::VectorXd estimate;             ///< SI.
  Eigen::MatrixXd covariance;  ///< In the estimator's scale (logarithms where it uses them).
  double torque_sd_nm = 0.0;
  double emg_cv = 0.0;
  double model_error =
      0.0;  ///< IdentificationResult::model_error: more recording does not mend it.
  /// Its rows: what the run itself says of each number is what is known of it now.
  std::vector<identification::ParameterEstimate> estimates;
};

/// Throws ReadError if the folder holds no parameters.json with a fit by method torque.
[[nodiscard]] EarlierRun read_earlier_run(const std::filesystem::path& folder);

/// The same of a fit by method torque that is at hand.
[[nodiscard]] EarlierRun earlier_run(const identification::IdentificationResult& fit);

}  // namespace myoid
