#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/intervals/result.h"
#include "myoid/methods/cross_validation.h"
#include "myoid/report/report.h"

namespace myoid {

/// The share of the torque that a prediction explains, over several trials and joints, both below
/// the fit's own cut-off:
///
///   R2 = 1 - (rms / spread)^2
///
/// with `spread` the torque's standard deviation about each joint's mean over all the trials.
struct Explained {
  Eigen::Index samples = 0;
  double rms_nm = 0.0;
  double spread_nm = 0.0;
  double torque_rms_nm = 0.0;  ///< RMS error of predicting no torque.

  [[nodiscard]] double r2() const;
  /// True if no torque would be nearer, or if R2 is below -1 and the error at least half of the
  /// torque. R2 below -1 means a larger error than that of an unrelated torque of the same size;
  /// the second condition is there because a nearly constant torque easily has a negative R2.
  [[nodiscard]] bool is_wrong() const;
  /// "R2 0.93: 0.74 N m rms below 1.5 Hz, where the torque varies by 2.80".
  [[nodiscard]] std::string text() const;
};

/// The score of a trial's prediction below its `smooth_hz`.
[[nodiscard]] identification::Score smoothed_score(const identification::TrialFit& fit);

/// Returns this for the trials that were fitted, or for the trials held back.
[[nodiscard]] Explained explained(const identification::IdentificationResult& fit,
                                  bool calibration);
/// Returns this for the trials left out in turn.
[[nodiscard]] Explained explained(const std::vector<identification::Fold>& folds);

/// A left-out trial that is predicted worse than the others by more than chance.
struct OutlyingFold {
  std::string trial, joint;
  double rms_nm = 0.0, r2 = 0.0;
  double usual_rms_nm = 0.0;  ///< Median of the joint's folds.
};
/// The logarithm of its error lies more than three robust standard deviations (1.4826 times the
/// median absolute deviation) above the median and at 1.5 times it at least, and its R2 below the
/// median, too: heavier trials err by more. Of five folds or more, by joint.
[[nodiscard]] std::vector<OutlyingFold> outlying_folds(
    const std::vector<identification::Fold>& folds);

/// Tests whether the fit makes the torque of the fitted trials and of those held back, and whether
/// the muscles have left the literature.
[[nodiscard]] std::vector<report::Gate> fit_gates(const identification::IdentificationResult& fit);

/// Tests whether the fit predicts left-out trials, better than the literature, and all of them
/// alike.
[[nodiscard]] std::vector<report::Gate> fold_gates(const std::vector<identification::Fold>& folds);

}  // namespace myoid
