#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/methods/torque.h"

namespace myoid::fit {

struct CrossValidationOptions {
  FoldKind kind = FoldKind::trial;
  /// The setting of the caller that chooses `kind`, for messages.
  std::string setting = "folds";
};

/// One division of a study's trials: a fit uses the trials with `TrialData::calibration`, the others are predicted.
struct Split {
  std::string name;  ///< The trial, the condition, or "block 2 of 5".
  StudyData data;
};

/// Returns all splits of the calibration trials; trials held back for validation are in none. Needs at least two trials
/// or conditions, or trials with five blocks; otherwise empty, with the reason in `why_not`, if given.
[[nodiscard]] std::vector<Split> splits(const StudyData& data,
                                        const CrossValidationOptions& options = {},
                                        std::string* why_not = nullptr);

/// The EMG channel whose effort exceeds the fitted effort most.
struct UnseenEffort {
  std::string channel;  ///< Empty: no channel exceeds its effort in the fitted trials.
  double ratio = 1.0;   ///< Greatest effort in held-back trials divided by that in fitted trials.
};

/// Compares the greatest efforts (mean of the activation over half a second, within the trial) of
/// held-back and fitted trials, and returns the channel with the greatest ratio. A prediction
/// beyond the fitted efforts depends on the law alone: force is proportional to activation.
[[nodiscard]] UnseenEffort unseen_effort(const StudyData& data);

/// The predictions of one part that was left out.
struct Fold : FiberScores {
  std::string trial;  ///< Or the condition, or "block 2 of 5".
  std::string joint;  ///< The joint whose torque is predicted.
  /// Parameters of the fit without this part.
  std::vector<ParameterEstimate> parameters;
  EmgLag lag = EmgLag::delay;
  bool converged = true;
  Score fitted;          ///< Score of the same parameters on the fitted trials.
  Score identified;      ///< Score of the fit to the others.
  Score band;            ///< Score with both torques below the fit's own cut-off.
  Score literature;      ///< Score of literature parameters with the one gain that fits the others best.
  Score regression;      ///< Score of the torque's regression on activation times moment arm of every
                         ///< muscle.
  Score constant;        ///< Score of the mean torque of the others.
  double gain = 1.0;     ///< Gain of the literature's parameters.
  double lag_s = 0.0;    ///< Lag of the identified prediction.
  double covered = 0.0;  ///< Share of the samples within the prediction's 95 % band.
  UnseenEffort unseen;   ///< Effort beyond that of the fitted trials.
  /// Trials one after another; the standard deviation is empty where it is not known.
  Eigen::VectorXd time_s, measured_nm, predicted_nm, predicted_sd_nm, literature_nm;
};

/// Fits the calibration trials of a split. It may first update data and options that depend on the
/// fitted trials, such as activations relative to the greatest effort in them.
using SplitFit = std::function<IdentificationResult(StudyData& data, EstimatorOptions& options)>;

/// Leaves out and predicts one part after another, folds in parallel; samples are never shuffled. `fit` is the reported
/// fit on fewer trials; it gets `of_a_fold(options)`, which keeps EstimatorOptions::begin_at. Predictions are those of
/// TrialPredictions. One entry for each part and joint; empty where `splits` is.
[[nodiscard]] std::vector<Fold> cross_validate(const StudyData& data,
                                               const SplitFit& fit,
                                               const EstimatorOptions& options,
                                               const CrossValidationOptions& how = {});

/// Returns the options of a fold's fit: the reported fit's without intervals, tables and progress.
[[nodiscard]] EstimatorOptions of_a_fold(EstimatorOptions options);

}  // namespace myoid::fit
