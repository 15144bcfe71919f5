#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/fit/posterior/likelihood.h"

namespace myoid::run {

/// The errors of a planned recording.
struct PlannedErrors {
  double torque_sd_nm = 0.3;
  /// Noise of the envelopes over the noise that their bandwidth predicts.
  double emg_factor = 1.0;
  double model_error = 0.0;  ///< Relative size s.
};

/// The information of a movement about the unknowns z and the unseen quantities x, by the
/// likelihood of the posterior.
///
///   M = [L J, L S W]' A^-1 [L J, L S W],   unknowns and quantities, square
///
/// A is the covariance of the run's own errors (Likelihood). Movements of one person share x, so their M add; each x
/// has a prior precision of 1, and z its priors. The covariance of z is a block of the inverse.
class PosteriorInformation {
 public:
  /// Prepares the likelihood. `session` holds all movements by a person with the starting values: its lengths are the
  /// recorded lengths to which errors are relative. Geometry and scales that are exact by `believed` have weight 0.
  PosteriorInformation(fit::StudyData muscles,
                       std::vector<fit::TrialData> session,
                       fit::EstimatorOptions options,
                       const PlannedErrors& errors,
                       fit::Believed believed);

  /// Returns the names of x.
  [[nodiscard]] const std::vector<std::string>& quantities() const { return quantities_; }
  /// Returns M of a noise-free trial of a person with these unknowns. The EMG's noise is that of the errors, behind
  /// the estimator's smoothing (drive_of_clean).
  [[nodiscard]] Eigen::MatrixXd of(const fit::TrialData& trial, const Eigen::VectorXd& z) const;

 private:
  fit::StudyData muscles_;
  fit::EstimatorOptions options_;
  fit::NoiseValues noise_;
  std::vector<std::string> unknowns_;
  fit::Believed believed_;
  fit::Recorded session_;
  std::vector<std::string> quantities_;
};

}  // namespace myoid::run
