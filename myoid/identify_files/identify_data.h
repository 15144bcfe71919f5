#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/identify_files/muscles_csv.h"

namespace myoid {

/// The files of `myoid identify`, one per trial, in the same order; moment arms one per trial and
/// coordinate, trial by trial.
struct IdentifySources {
  std::vector<std::string> activations, lengths;
  std::vector<std::string> velocities;  ///< None: by a spline through the lengths.
  std::vector<std::string> forces, moment_arms, torques;
  std::vector<std::string> motions;  ///< Joint angles (.mot, .sto); none: no motion of the joints.
  std::optional<double> motion_cutoff_hz;  ///< They are smoothed, -3 dB here; empty: not at all.
  std::vector<std::string> coordinates;    ///< Columns of the torque files; none: their only one.
  bool torque = true;                      ///< Fitted to torques; else to forces.
  std::optional<double> start_s, end_s;    ///< [s]
};

/// What the estimators need, on the clock of each trial's lengths and over the time that all of its
/// files cover. `remark` is told what readers mended or left out and what is suspicious, of one
/// trial after the other (`check_identify_trial`), and of trials that have the same activations.
/// Throws InvalidInput for files that do not match the number of trials, ReadError for missing
/// columns and files that do not overlap, and as `check_identify_trial`.
[[nodiscard]] identification::StudyData read_identify_data(
    const IdentifySources& sources,
    const MuscleTable& table,
    const std::function<void(const std::string&)>& remark);

}  // namespace myoid
