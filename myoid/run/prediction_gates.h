#pragma once

#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/methods/cross_validation.h"
#include "myoid/page/report.h"

namespace myoid::run {

/// The share of the torque that a prediction explains, over several trials and joints. Prediction
/// and torque are low-passed at the fit's cut-off:
///
///   R2 = 1 - (rms / spread)^2
///
/// with `spread` the torque's standard deviation about each joint's mean over all the trials.
struct Explained {
  Eigen::Index samples = 0;
  double rms_nm = 0.0;
  double spread_nm = 0.0;
  double torque_rms_nm = 0.0;  ///< RMS error of a prediction of 0.

  [[nodiscard]] double r2() const;
  /// Returns true if a prediction of 0 has a smaller error, or if R2 is below 0 (the mean predicts better) and the
  /// error at least half of the torque. The last condition spares nearly constant torques, whose R2 is easily negative.
  [[nodiscard]] bool is_wrong() const;
  /// Returns "R2 0.93: 0.74 N m rms below 1.5 Hz, where the torque is 4.10 rms and varies
  /// by 2.80".
  [[nodiscard]] std::string text() const;
};

/// Returns the explained share of the fitted trials (`calibration`), or of the held-back trials.
[[nodiscard]] Explained explained(const fit::IdentificationResult& fit, bool calibration);
/// Returns the explained share of the trials that are left out in turn.
[[nodiscard]] Explained explained(const std::vector<fit::Fold>& folds);

/// Returns a sentence with the numbers if left-out trials are predicted much worse than fitted
/// ones, otherwise an empty text. Samples of one movement share the model's error, which more
/// samples of it do not average out: the fit then follows this error, away from the priors.
[[nodiscard]] std::string generalises_badly(const std::vector<fit::Fold>& folds);

/// A left-out trial with a prediction error that chance does not explain.
struct OutlyingFold {
  std::string trial, joint;
  double rms_nm = 0.0, r2 = 0.0;
  double usual_rms_nm = 0.0;  ///< Median of the joint's folds.
};
/// Returns the outliers among at least five folds, by joint. The logarithm of an outlier's error exceeds the median by
/// three robust standard deviations (1.4826 times the median absolute deviation), its error is at least 1.5 times the
/// median, and its R2 is below the median, too, because heavier trials have larger errors.
[[nodiscard]] std::vector<OutlyingFold> outlying_folds(const std::vector<fit::Fold>& folds);

/// Tests whether the fit explains the torque of the fitted and of the held-back trials, and whether
/// the muscles agree with the literature.
[[nodiscard]] std::vector<page::Gate> fit_gates(const fit::IdentificationResult& fit);

inline constexpr std::string_view kRecordMore = "Record a maximal contraction, or trials of like effort.";

/// Tests whether the fit predicts left-out trials, better than the literature, and all of them equally well.
/// Without folds the question was not asked; `wanted`: the study asks it. `remedy`: what to do about efforts beyond
/// those that were fitted.
[[nodiscard]] std::vector<page::Gate> fold_gates(const std::vector<fit::Fold>& folds,
                                                 bool wanted = true,
                                                 const std::string& remedy = std::string(kRecordMore));

}  // namespace myoid::run
