#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "myoid/methods/torque.h"
#include "myoid/methods/unseen_effort.h"

namespace myoid::identification {

/// Shift [s] of the prediction, within +-limit_s, at which it correlates best with the measurement:
/// positive if the prediction comes late.
[[nodiscard]] double best_lag_s(const Eigen::VectorXd& time_s,
                                const Eigen::VectorXd& measured,
                                const Eigen::VectorXd& predicted,
                                double limit_s = 0.2);

struct CrossValidationOptions {
  FoldKind kind = FoldKind::trial;
  int blocks = 5;
  double gap_s = 0.5;
  bool paper = true;  ///< Method `paper` on the others, too, where there are forces.
};

/// One way to part the trials of a study: a fit sees those with `TrialData::calibration`, the
/// others are predicted.
struct Split {
  std::string name;  ///< The trial, the condition, or "block 2 of 5".
  StudyData data;
};

/// All splits of the calibration trials; trials that are held back anyway are in none. At least two
/// trials or conditions are needed, and trials that have five blocks; empty otherwise, and
/// `why_not`, if given, says the reason.
[[nodiscard]] std::vector<Split> splits(const StudyData& data,
                                        const CrossValidationOptions& options = {},
                                        std::string* why_not = nullptr);

/// One thing left out.
struct Fold {
  std::string trial;  ///< Or the condition, or "block 2 of 5".
  std::string joint;  ///< Whose torque is predicted.
  /// The fit that did not see it. Its parameters alone make the prediction.
  std::vector<ParameterEstimate> parameters;
  EmgLag lag = EmgLag::delay;
  bool converged = true;
  Score fitted;            ///< By the same parameters, of the trials that the fit saw.
  Score identified;        ///< Fitted on the others.
  Score smooth;            ///< The same, the prediction below `smooth_hz` (smooth_prediction.h).
  double smooth_hz = 0.0;  ///< Of the first trial; 0: as it is.
  Score band;              ///< The same, both torques below the fit's own cut-off.
  Score literature;        ///< Literature parameters with the one gain that fits the others best.
  Score regression;        ///< Torque regressed on activation times moment arm of every muscle.
  Score constant;          ///< Mean torque of the others.
  std::optional<Score> paper;  ///< Method paper on the others, where there are forces.
  double gain = 1.0;           ///< That gain.
  double lag_s = 0.0;          ///< Of the identified prediction.
  UnseenEffort unseen;         ///< Effort beyond that of the fitted trials.
  Eigen::VectorXd time_s, measured_nm, predicted_nm,
      literature_nm;  ///< Trials one after the other.
};

/// Fits the calibration trials of a split. It may first bring up to date what depends on the trials
/// that the fit sees, such as activations relative to the greatest effort in them.
using SplitFit = std::function<IdentificationResult(StudyData& data)>;

/// Leaves out in turn and predicts, folds in parallel; never shuffled samples. `fit` is the fit
/// that is reported, on fewer trials: nothing of another fit is handed to it. A prediction is the
/// muscles' law with the fold's parameters, not smoothed. One entry for each thing left out and
/// joint; empty where `splits` is.
[[nodiscard]] std::vector<Fold> cross_validate(const StudyData& data,
                                               const SplitFit& fit,
                                               const EstimatorOptions& options,
                                               const CrossValidationOptions& how = {});
/// The same of `identify_torque` with these options.
[[nodiscard]] std::vector<Fold> cross_validate(const StudyData& data,
                                               const TorqueOptions& options = {},
                                               const CrossValidationOptions& how = {});

/// Tells if fits explain the trials that they see much better than those that they do not: a
/// sentence, with the numbers; empty where not. Samples of one movement share the model's error,
/// which more of the same samples do not average out: the fit then follows that error, away from
/// what is known beforehand.
[[nodiscard]] std::string generalises_badly(const std::vector<Fold>& folds);

/// Names the folds that are predicted badly (R2 below 0.5) and whose EMG reaches 1.5 times that of
/// the trials fitted or more: "'fast': biceps 2.8 times". Empty where there are none.
[[nodiscard]] std::string beyond_what_was_fitted(const std::vector<Fold>& folds);

/// Options of a fold's fit: those of the reported one without its intervals, tables and progress.
[[nodiscard]] EstimatorOptions of_a_fold(EstimatorOptions options);

}  // namespace myoid::identification
