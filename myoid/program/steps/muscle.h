#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/muscle/isolated_muscle.h"
#include "myoid/muscle/muscle_file.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/muscle_fit.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Options for one muscle alone in a testing machine. Files are .sto, .mot, .csv, .tsv or .txt.
struct MuscleOptions {
  Call call;
  std::string muscle;                ///< The muscle (.toml).
  std::vector<std::string> lengths;  ///< Length of fiber and tendon over time; several with `fit`.
  std::string column;                ///< Column of the lengths; empty: the only one.
  /// The length is scale times the file's numbers plus the offset [m]; one scale, or one per file.
  std::vector<double> scales{1.0};
  double offset_m = 0.0;
  /// Exactly one of them: numbers in 0..1 or files; one, or one per length.
  std::vector<std::string> activation, excitation;
  std::string drive_column;                 ///< Column of the files of the drive; empty: the only one.
  std::string initial_activation = "0.01";  ///< With `excitation`: a number, or "settled" on it.
  std::vector<std::string> measured;        ///< Force [N] over time; with `fit` one file for each length.
  std::string measured_column;              ///< Column of the forces; empty: the only one.
  std::vector<std::string> fit;             ///< Parameters to identify; empty: simulates only.
  std::vector<std::string> own;             ///< Of `fit`, parameters of which each recording has its own value.
  std::vector<std::string> laws;            ///< Sets of laws to compare, or "all"; empty: those of the muscle.
  std::optional<double> isometric_n;        ///< Reference force of relative errors; empty: F_max.
  double tolerance = 1e-9;                  ///< Relative tolerance of the integration.
  std::string out;                          ///< File of `write_muscle`.
  std::string fitted;                       ///< File of the muscle with the estimates (.toml).

  /// Returns the files that are read.
  [[nodiscard]] std::vector<std::string> inputs() const;
};
void visit(MuscleOptions& options, study::SettingVisitor& v);

/// Mean absolute difference between simulated and measured force, at the times of measurement.
struct ForceComparison {
  double error_n = 0.0;
  double share = 0.0;  ///< Error relative to the reference force.
  Eigen::Index samples = 0;
};

/// The simulated experiment.
struct ImposedLength {
  muscle::IsolatedMuscleResult simulated;
  std::optional<ForceComparison> comparison;  ///< If a force was measured.
};

struct MuscleResult {
  std::string name;                        ///< Name of the muscle.
  std::optional<ImposedLength> simulated;  ///< Either this or `fit`.
  std::optional<MuscleFit> fit;
  std::optional<muscle::MuscleFile> fitted;  ///< With `fit`: the muscle with its numbers and laws.
  std::string command;
  std::vector<Remark> remarks;
};

/// Simulates the muscle under the imposed length, or fits it to the measured forces. Throws InvalidInput for options
/// that contradict each other, and for lengths and forces that this muscle cannot have.
[[nodiscard]] MuscleResult muscle(const MuscleOptions& options);

/// Writes the simulated series (.sto), or the table of the fits (.csv): left out, parameter, unit,
/// start, estimate, std_error, at_bound, scatter, and of the fit to all ci_low, ci_high, verdict.
void write_muscle(const MuscleResult& result, const std::filesystem::path& path);
/// Writes the muscle with the numbers of the fit (.toml).
void write_fitted_muscle(const MuscleResult& result, const std::filesystem::path& path);

}  // namespace myoid::program
