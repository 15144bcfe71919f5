#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/units.h"
#include "myoid/math/least_squares.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::identification {

/// Whether a number may be believed.
enum class Verdict {
  identified,        ///< The recording determines it.
  weak,              ///< It says something, but the interval is wide.
  prior_dominated,   ///< The value is mostly what was known beforehand.
  not_identifiable,  ///< The recording cannot tell.
  non_physical,      ///< The fit left what a muscle can be: it describes something else.
};
[[nodiscard]] std::string_view name(Verdict verdict);

/// One row of parameters.csv.
struct ParameterEstimate {
  std::string muscle;  ///< Or the EMG channel, or "subject".
  std::string parameter;
  Unit unit = Unit::dimensionless;
  std::string method;    ///< paper | torque
  std::string fit_case;  ///< shortening | lengthening | both
  double initial = 0.0;
  double estimate = 0.0;
  std::optional<double> std_error;
  std::optional<double> ci_low, ci_high;  ///< 95 %
  std::optional<double> prior_mean, prior_sd;
  std::optional<double> shrinkage;  ///< 1 - posterior variance / prior variance.
  bool at_bound = false;
  Verdict verdict = Verdict::not_identifiable;
  std::string reason;  ///< One sentence.
};

/// How well a trial is predicted.
struct TrialFit {
  std::string trial;
  bool calibration = true;
  Eigen::VectorXd time_s;
  Eigen::VectorXd torque_nm;             ///< From inverse dynamics.
  Eigen::VectorXd literature_torque_nm;  ///< Starting parameters.
  Eigen::VectorXd torque_fit_nm;         ///< Identified parameters.
  Eigen::MatrixXd literature_force_n;    ///< n x m
  Eigen::MatrixXd force_fit_n;           ///< n x m
  double rmse_nm = 0.0;
  double r2 = 0.0;  ///< 1 - SSE/SST.
};

struct IdentificationResult {
  std::string method;
  math::Termination termination = math::Termination::no_descent;
  std::string message;
  std::vector<ParameterEstimate> estimates;
  std::vector<muscle::HillParameters<double>> muscles;  ///< With the estimates (method torque).
  double delay_s = 0.0;
  Eigen::VectorXd solution;  ///< In the solver's scale (method torque).
  Eigen::MatrixXd
      covariance;  ///< Of the free parameters in solver's scale (logarithms where logarithmic).
  std::vector<std::string> free_parameters;  ///< Its rows.
  std::vector<std::string> collinear;  ///< Pairs that the data hardly tell apart, as sentences.
  int samples_used = 0;
  int samples_dropped = 0;
  double effective_samples = 0.0;
  double torque_sd_nm = 0.0;  ///< s_T
  double emg_cv = 0.0;        ///< c_a
  double condition = 0.0;
  int iterations = 0;
  double seconds = 0.0;
  std::vector<TrialFit> trials;
};

}  // namespace myoid::identification
