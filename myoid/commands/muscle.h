#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/commands/muscle_fit.h"
#include "myoid/commands/muscle_options.h"
#include "myoid/muscle/isolated_muscle.h"

namespace myoid::commands {

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
