#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/commands/muscle_fit.h"
#include "myoid/commands/muscle_options.h"
#include "myoid/muscle/isolated_muscle.h"

namespace myoid::commands {

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
  std::string command;
  std::vector<Remark> remarks;
};

/// Simulates the muscle under the imposed length, or fits it to the measured forces. Throws InvalidInput for options
/// that contradict each other, and for lengths and forces that this muscle cannot have.
[[nodiscard]] MuscleResult muscle(const MuscleOptions& options);

/// Writes the simulated series (.sto), or the table of the fits (.csv): left out, parameter, unit,
/// start, estimate, std_error, at_bound.
void write_muscle(const MuscleResult& result, const std::filesystem::path& path);

}  // namespace myoid::commands
