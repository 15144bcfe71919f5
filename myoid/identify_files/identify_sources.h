#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "myoid/run/given_check.h"

namespace myoid {

/// The files of `myoid identify`, one per trial, in the same order; moment arms one per trial and
/// coordinate, trial by trial.
struct IdentifySources {
  std::vector<std::string> activations, lengths;
  std::vector<std::string> velocities;  ///< Empty: rates of the spline through the lengths.
  std::vector<std::string> forces, moment_arms, torques;
  std::vector<std::string> motions;        ///< Joint angles (.mot, .sto); empty: no motion of the joints.
  std::optional<double> motion_cutoff_hz;  ///< Cut-off (-3 dB) that smooths the angles; empty: not smoothed.
  std::vector<std::string> coordinates;    ///< Columns of the torque files; empty: the only column.
  /// Trials that are not fitted, by the names of `trial_named`.
  std::vector<std::string> held_back;
  bool torque = true;                    ///< Fits torques; false: forces.
  std::optional<double> start_s, end_s;  ///< [s]
  bool resting_torque_is_free = false;   ///< The torque of the joint without activity is fitted.
};

/// Receives a sentence on the files or their values.
using TellRemark = std::function<void(const std::string&)>;

/// Throws InvalidInput if a kind of files does not match the number of trials.
void require_counts(const IdentifySources& sources);

/// Returns the names of one trial's files.
[[nodiscard]] TrialFiles files_of(const IdentifySources& sources, std::size_t trial);

/// Returns "walk" for a single file of lengths, "2 (walk)" for one of several. Files of equal name
/// get as many folders as distinguish them: "2 (fast/walk)".
[[nodiscard]] std::string trial_label(const std::vector<std::string>& lengths, std::size_t number);

/// Returns the trial of a number from 1, of a file of lengths, or of this file's name without
/// ending. Throws InvalidInput for no or several such trials.
[[nodiscard]] std::size_t trial_named(const std::string& name, const std::vector<std::string>& lengths);

}  // namespace myoid
