#pragma once

#include <string>
#include <vector>

#include "myoid/commands/muscle_options.h"
#include "myoid/muscle/fit_isolated.h"
#include "myoid/muscle/muscle_file.h"

namespace myoid::commands {

/// Mean absolute errors of one recording, relative to the reference force.
struct RecordingErrors {
  std::string recording;
  double starting_values = 0.0, fitted = 0.0;
  double predicted = 0.0;  ///< By the fit to the other recordings; NaN if there is no other.
};

/// The parameters from all recordings.
struct MuscleFit {
  muscle::IsolatedFit all;  ///< Standard errors include the spread over the recordings (jackknife).
  std::vector<muscle::IsolatedFit> without_one;  ///< Without recording 0, 1, ...; empty for one.
  std::vector<RecordingErrors> errors;
  double relative_to_n = 0.0;  ///< Reference force of the relative errors.
  bool converged = false;      ///< All of these fits converged.
  bool misses = false;         ///< A recording's fitted error exceeds a guess's (kErrorOfAGuess).
};

/// Fits the parameters to all recordings and to all but each one, and compares the results. Throws
/// InvalidInput for forces that the muscle cannot produce.
[[nodiscard]] MuscleFit fit_muscle(const MuscleOptions& options, const muscle::MuscleFile& file, Remarks& remarks);

}  // namespace myoid::commands
