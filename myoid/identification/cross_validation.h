#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/identification/torque.h"

namespace myoid::identification {

/// Shift [s] of the prediction, within +-limit_s, at which it correlates best with the measurement:
/// positive if the prediction comes late.
[[nodiscard]] double best_lag_s(const Eigen::VectorXd& time_s,
                                const Eigen::VectorXd& measured,
                                const Eigen::VectorXd& predicted,
                                double limit_s = 0.2);

/// What is left out of each fit.
enum class FoldKind {
  trial,      ///< One trial.
  condition,  ///< All trials of one condition (TrialData::condition; a trial without one is its
              ///< own).
  block,  ///< A fifth of every trial, with half a second on either side that serves neither side.
};

struct CrossValidationOptions {
  FoldKind kind = FoldKind::trial;
  int blocks = 5;
  double gap_s = 0.5;
};

/// One thing left out.
struct Fold {
  std::string trial;  ///< Or the condition, or "block 2 of 5".
  std::string joint;  ///< Whose torque is predicted.
  Score identified;   ///< Fitted on the others.
  Score band;         ///< The same, both torques below the fit's own cut-off.
  Score literature;   ///< Literature parameters with the one gain that fits the others best.
  Score regression;   ///< Torque regressed on activation times moment arm of every muscle.
  Score constant;     ///< Mean torque of the others.
  std::optional<Score> paper;  ///< Method paper on the others, where there are forces.
  double gain = 1.0;           ///< That gain.
  double lag_s = 0.0;          ///< Of the identified prediction.
  Eigen::VectorXd time_s, measured_nm, predicted_nm,
      literature_nm;  ///< Trials one after the other.
};

/// Leaves out in turn and predicts, folds in parallel; never shuffled samples. One entry for each
/// thing left out and joint. At least two folds are needed; empty otherwise.
[[nodiscard]] std::vector<Fold> cross_validate(const StudyData& data,
                                               const TorqueOptions& options = {},
                                               const CrossValidationOptions& folds = {});

}  // namespace myoid::identification
