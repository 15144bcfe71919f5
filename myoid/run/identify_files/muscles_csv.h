#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/remark.h"

namespace myoid::run {

/// The content of muscles.csv.
struct MuscleTable {
  std::vector<fit::MuscleSetup> muscles;
  std::vector<fit::ParameterRule> rules;  ///< Parameters that are not held by default.
  std::vector<Remark> remarks;            ///< Of the reader, with the file's name.
  /// Muscles whose start of a parameter is the literature's, by parameter.
  std::map<std::string, std::vector<std::string>> assumed;
};

/// Reads muscles.csv: `muscle`, `max_isometric_force`, `optimal_fiber_length`, and any number of known columns of
/// further parameters (`muscle_columns`; starting values, SI). Missing numbers of the source paper's law are the
/// literature's (`muscle::literature_parameters`). Further columns are `<parameter>_fixed`, `_lower`, `_upper`,
/// `_prior_sd`; `emg`, the channel, if its name differs from the muscle's. `within_bounds`: the method keeps to bounds,
/// so a start must lie within them. Throws ReadError with the line for an unknown column, a missing or impossible
/// number and two muscles of one name.
[[nodiscard]] MuscleTable read_muscles_csv(const std::filesystem::path& path, bool within_bounds);

}  // namespace myoid::run
