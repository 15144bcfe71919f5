#pragma once

#include <string>
#include <vector>

#include "myoid/commands/call.h"

namespace myoid::commands {

/// Options for one muscle alone in a testing machine. Files are .sto, .mot, .csv, .tsv or .txt.
struct MuscleOptions {
  Call call;
  std::string muscle;                ///< The muscle (.toml).
  std::vector<std::string> lengths;  ///< Length of fiber and tendon over time; several with `fit`.
  std::string column;                ///< Column of the lengths; empty: the only one.
  /// The length is scale times the file's numbers plus the offset [m]; one scale, or one per file.
  std::vector<double> scales{1.0};
  double offset_m = 0.0;
  std::string activation, excitation;       ///< Exactly one: a number in 0..1, or a file.
  std::string initial_activation = "0.01";  ///< With `excitation`: a number, or "settled" on it.
  std::vector<std::string> measured;        ///< Force [N] over time; with `fit` one file for each length.
  std::vector<std::string> fit;             ///< Parameters to identify; empty: simulates only.
  double isometric_n = 0.0;                 ///< Reference force of relative errors; 0: F_max.
  double tolerance = 1e-9;                  ///< Relative tolerance of the integration.
};

}  // namespace myoid::commands
