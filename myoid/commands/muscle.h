#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/muscle/fit_isolated.h"
#include "myoid/muscle/isolated_muscle.h"

namespace myoid::commands {

/// One muscle alone in a testing machine. Files are .sto, .mot, .csv, .tsv or .txt.
struct MuscleOptions {
  Call call;
  std::string muscle;                ///< The muscle (.toml).
  std::vector<std::string> lengths;  ///< Length of fiber and tendon over time; several with `fit`.
  std::string column;                ///< Their column; empty: the only one.
  /// The length is scale times the file's numbers plus the offset [m]; one scale, or one a file.
  std::vector<double> scales{1.0};
  double offset_m = 0.0;
  std::string activation, excitation;       ///< One of them: a number in 0..1, or a file.
  std::string initial_activation = "0.01";  ///< With `excitation`: a number, or "settled" on it.
  std::vector<std::string> measured;  ///< Force [N] over time; with `fit` one for each length.
  std::vector<std::string> fit;       ///< Parameters to identify; none: only simulate.
  double isometric_n = 0.0;           ///< Force that errors are related to; 0: F_max.
  double tolerance = 1e-9;            ///< Relative, of the integration.
};

/// Mean absolute difference from a measured force at its times.
struct ForceComparison {
  double error_n = 0.0;
  double share = 0.0;  ///< Of the force that errors are related to.
  Eigen::Index samples = 0;
};

/// The simulated experiment.
struct ImposedLength {
  muscle::IsolatedMuscleResult simulated;
  std::optional<ForceComparison> comparison;  ///< Where a force was measured.
};

/// Mean absolute errors of one recording, as shares of the force that errors are related to.
struct RecordingErrors {
  std::string recording;
  double starting_values = 0.0, fitted = 0.0;
  double predicted = 0.0;  ///< By the fit of the other recordings; NaN where there is no other.
};

/// The parameters from all recordings.
struct MuscleFit {
  muscle::IsolatedFit all;  ///< Standard errors hold the spread over the recordings (jackknife).
  std::vector<muscle::IsolatedFit> without_one;  ///< Without recording 0, 1, ...; empty for one.
  std::vector<RecordingErrors> errors;
  double relative_to_n = 0.0;  ///< What the errors are related to.
  bool converged = false;      ///< All of these fits.
  bool misses = false;         ///< A recording's fitted force errs by more than a guess would.
};

struct MuscleResult {
  std::string name;                        ///< The muscle's.
  std::optional<ImposedLength> simulated;  ///< One of these two.
  std::optional<MuscleFit> fit;
  std::string command;
  std::vector<Remark> remarks;
};

/// Simulates the muscle under the imposed length, or fits it to the measured forces. Throws
/// InvalidInput for options that contradict each other, lengths that this muscle cannot have and
/// forces that it cannot make.
[[nodiscard]] MuscleResult muscle(const MuscleOptions& options);

/// Writes the simulated series (.sto), or the table of the fits (.csv): left out, parameter, unit,
/// start, estimate, std_error, at_bound.
void write_muscle(const MuscleResult& result, const std::filesystem::path& path);

}  // namespace myoid::commands
