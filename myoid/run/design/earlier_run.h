#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/result.h"

namespace myoid::run {

/// The results of a finished run (its parameters.json, method torque): the knowledge before the next recording.
struct EarlierRun {
  std::vector<std::string> parameters;  ///< "BIC.max_isometric_force"
  Eigen::VectorXd estimate;             ///< SI.
  Eigen::MatrixXd covariance;           ///< In the estimator's scale (logarithms where it uses them).
  double torque_sd_nm = 0.0;
  double emg_cv = 0.0;
  /// IdentificationResult::model_error, which more recording does not reduce.
  double model_error = 0.0;
  /// The rows of the run, with their verdicts.
  std::vector<fit::ParameterEstimate> estimates;
};

/// Reads the results in a folder. Throws ReadError if the folder holds no parameters.json with a fit by method torque.
[[nodiscard]] EarlierRun read_earlier_run(const std::filesystem::path& folder);

/// Returns the results of a fit by method torque.
[[nodiscard]] EarlierRun earlier_run(const fit::IdentificationResult& fit);

}  // namespace myoid::run
