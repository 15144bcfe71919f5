#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "myoid/recording/tables/csv_reader.h"

namespace myoid::run {

/// The column of a quantity in muscles.csv, with the unit of its numbers.
struct MuscleColumn {
  std::size_t index = 0;
  double to_si = 1.0;             ///< From the unit in the header, "F_max [kN]"; else 1.
  bool in_fiber_lengths = false;  ///< Optimal fiber lengths per second instead of m/s.
};

/// Finds the columns of a muscles.csv by this program's own names: `muscle`, `emg`, the parameters and
/// `<parameter>_fixed`, `_lower`, `_upper`, `_prior_sd`. Accepts names of OpenSim, CEINMS, the NMSM pipeline and MATLAB
/// scripts ("maxIsometricForce", "F_max", "lMo", "lTs", "name"), in any case and with any signs between the words, and
/// a unit in brackets. Throws ReadError at the header's line for an unknown name, with the nearest known one, a unit of
/// another quantity, two columns of one quantity, and a missing name, max_isometric_force or optimal_fiber_length.
[[nodiscard]] std::map<std::string, MuscleColumn> muscle_columns(const recording::CsvTable& table,
                                                                 const std::filesystem::path& path);

}  // namespace myoid::run
