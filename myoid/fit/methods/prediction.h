#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// The muscles in one trial.
struct Prediction {
  Eigen::MatrixXd force_n;     ///< n x m
  Eigen::VectorXd torque_nm;   ///< n
  Eigen::MatrixXd activation;  ///< n x m: activation of each muscle's EMG channel.
};
/// Predicts with the paper's law of these muscles, one delay and gains of 1.
[[nodiscard]] Prediction predict(const StudyData& data,
                                 const TrialData& trial,
                                 const std::vector<muscle::HillParameters<double>>& muscles,
                                 double delay_s,
                                 EmgLag lag = EmgLag::delay);
/// Predicts with all numbers of the model, for the trial's first joint (others: `of_joint`).
[[nodiscard]] Prediction predict(const StudyData& data, const TrialData& trial, const ModelValues& values, EmgLag lag);
/// Predicts fitted and other trials by a fit. Every number of a validation comes from these predictions.
///
/// By the posterior the torque is the expectation of a measured torque, given the torque of the fitted trials,
///
///   T* = T^(z) + S W x,   x the expectation of the unseen quantities (fit/posterior/unseen.h),
///
/// from the drives behind the envelopes. Its variance is that of z, of x given z, and of the noise. A fit without noise
/// parameters (exact data) predicts by the law alone, without standard deviations. A force's is by parameters only.
class TrialPredictions {
 public:
  /// The members of `fit` in use: `values`, `lag`, `solution`, `covariance` and `noise`. References must outlive it.
  TrialPredictions(const StudyData& data, const EstimatorOptions& options, const IdentificationResult& fit);
  ~TrialPredictions();

  /// Predicts one joint's view of a trial (`of_joint`). Literature's torque and forces stay empty.
  [[nodiscard]] TrialFit of(const TrialData& trial) const;

 private:
  struct ByPosterior;
  const StudyData& data_;
  const IdentificationResult& fit_;
  std::unique_ptr<ByPosterior> by_posterior_;
  double residual_cutoff_hz_ = 0.0;
};

/// Returns the options of a fit whose search begins at the answer of `fit` (EstimatorOptions::begin_at); unchanged
/// where `fit` is none of the posterior.
[[nodiscard]] EstimatorOptions beginning_at(const IdentificationResult& fit, EstimatorOptions options);

/// Returns the share of measured torques within 1.96 standard deviations of the prediction; NaN
/// without standard deviations.
[[nodiscard]] double covered_share(const Eigen::VectorXd& measured_nm,
                                   const Eigen::VectorXd& predicted_nm,
                                   const Eigen::VectorXd& sd_nm);

/// Returns a fit's entry for a trial that holds only the trial's own facts: name, joint, time and measured torque.
[[nodiscard]] TrialFit unfitted_trial(const TrialData& trial);

/// Fills both torques of `fit` from its muscle forces: sum over muscles of r F plus the joint's
/// resting torque. Nothing is filled where the trial has no moment arms.
void add_torques_of_forces(const TrialData& trial, TrialFit& fit);

}  // namespace myoid::fit
