#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/muscle/fit_isolated.h"
#include "myoid/program/steps/call.h"

namespace myoid::program {

/// Mean absolute errors of one recording, relative to the reference force.
struct RecordingErrors {
  std::string recording;
  double starting_values = 0.0;
  double fitted = 0.0;     ///< With the recording's own values.
  double predicted = 0.0;  ///< By the fit to the other recordings; NaN if there is no other.
};

/// The 95 % interval of an estimate and the verdict on it, by the rules of every other number.
struct EstimateJudgment {
  double low = 0.0, high = 0.0;
  fit::Verdict verdict;
  std::string reason;
};

/// The errors of one set of laws on recordings that took no part in its fits.
struct LawsComparison {
  muscle::LawSet laws = muscle::LawSet::millard;
  double predicted = 0.0;  ///< Mean over the recordings, relative to the reference force.
  /// Difference from the best set, mean and standard error over the recordings.
  double worse_by = 0.0, std_error = 0.0;
  bool ties = false;  ///< The difference is within 1.96 standard errors.
};

/// The parameters from all recordings.
struct MuscleFit {
  muscle::IsolatedFit all;  ///< Standard errors include the spread over the recordings (jackknife).
  std::vector<muscle::IsolatedFit> without_one;  ///< Without recording 0, 1, ...; empty for one.
  std::vector<EstimateJudgment> judgments;       ///< Of the estimates of `all`.
  std::vector<RecordingErrors> errors;           ///< Over the forces that took part.
  std::vector<LawsComparison> laws;              ///< Best first; empty unless several sets were compared.
  double relative_to_n = 0.0;                    ///< Reference force of the relative errors.
  bool converged = false;                        ///< All of these fits converged.
  bool misses = false;                           ///< A recording's fitted error exceeds a guess's (kErrorOfAGuess).
};

struct MuscleFitSettings {
  muscle::IsolatedFitOptions fit;
  std::vector<muscle::LawSet> laws;  ///< Sets to compare beside the laws of the start.
  double relative_to_n = 1.0;
};

/// Fits the parameters to all recordings and to all but each one, judges them and compares the results, under the laws
/// that predict left-out recordings best. Forces after a stretch of the active muscle that no Hill-type muscle makes
/// are left out. Throws InvalidInput for forces that the muscle cannot produce.
[[nodiscard]] MuscleFit fit_muscle(const muscle::IsolatedModel& start,
                                   const std::vector<muscle::IsolatedRecording>& recordings,
                                   const MuscleFitSettings& settings,
                                   Remarks& remarks);

}  // namespace myoid::program
