#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::run {

/// In a list of one file per trial: the trial has none.
inline constexpr std::string_view kNoFile = "none";

/// The files of `myoid identify`, one per trial, in the same order; moment arms one per trial and
/// coordinate, trial by trial.
struct IdentifySources {
  std::vector<std::string> activations, lengths;
  std::vector<std::string> velocities;  ///< Empty: rates of the spline through the lengths.
  std::vector<std::string> forces, moment_arms, torques;
  std::vector<std::string> fascicles;      ///< Measured fiber lengths; `kNoFile`: of this trial none.
  std::vector<std::string> motions;        ///< Joint angles (.mot, .sto); empty: no motion of the joints.
  std::optional<double> motion_cutoff_hz;  ///< Cut-off (-3 dB) that smooths the angles; empty: not smoothed.
  std::vector<std::string> coordinates;    ///< Columns of the torque files; empty: the only column.
  std::vector<std::string> held_back;      ///< Trials that are not fitted, by the names of `trial_named`.
};

/// Throws InvalidInput if a kind of files does not match the number of trials. `torque`: the fit is one to torques,
/// else to forces.
void require_counts(const IdentifySources& sources, bool torque);

/// Returns "walk" for a single file of lengths, "2 (walk)" for one of several. Files of equal name
/// get as many folders as distinguish them: "2 (fast/walk)".
[[nodiscard]] std::string trial_label(const std::vector<std::string>& lengths, std::size_t number);

/// Returns the trial of a number from 1, of a file of lengths, or of this file's name without
/// ending. Throws InvalidInput for no or several such trials.
[[nodiscard]] std::size_t trial_named(const std::string& name, const std::vector<std::string>& lengths);

}  // namespace myoid::run
