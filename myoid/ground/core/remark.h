#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/core/stretch.h"

namespace myoid::inline ground {

/// The weight of a remark, worst first.
enum class Severity {
  error,    ///< The input is refused.
  warning,  ///< A number may be wrong.
  note,     ///< Good to know.
  detail,   ///< How a file was read.
};
[[nodiscard]] std::string_view name(Severity severity);

/// The question that a remark answers. Programs distinguish remarks by this code, never by their words.
enum class RemarkCode {
  // Channels of a recording; the documentation of `myoid check` has one row for each.
  marker_unit,
  marker_gap,
  marker_jump,
  marker_swap,
  segment_not_rigid,
  emg_amplitude,
  emg_envelope,
  emg_flat,
  emg_clipped,
  emg_saturated,
  emg_hum,
  emg_low_signal,
  emg_crosstalk,
  emg_drift,
  emg_artifact,
  emg_over_reference,
  emg_gain,
  emg_offset,
  clock_uneven,
  clock_offset,
  clock_drift,
  plate_offset,
  plate_sign,
  plate_pressure_outside,
  // Files.
  general,  ///< Any other matter, described in words.
  reading,  ///< A reader chose among several readings of a file, or repaired it.
  refused,  ///< A file or setting cannot be used.
  unit_doubtful,
  clock_pause,
  channel_unusable,
  channel_missing,
  emg_rate,
  emg_processing,
  emg_cover,
  emg_length,
  // The study and its model.
  unanswered,
  no_maximal_contraction,
  no_body_mass,
  flat_activations,
  start_outside_bounds,
  model_unsupported,
  shared_muscle,
  shared_channel,
  idle_muscle,
  same_recording,
  // Motion and loads.
  angle_outside_range,
  angle_jump,
  motion_impossible,
  coordinate_absent,
  joint_undetermined,
  torque_impossible,
  mass_impossible,
  gravity_impossible,
  muscle_impossible,
  reserves_act,
  loads_unstated,
  held_mass_impossible,
  vertical_across_trunk,
  sides_exchanged,
  dynamometer_sign,
  load_misplaced,
  foreign_contact,
  unloaded_time,
  body_unsupported,
  resting_torque,
  // A muscle alone.
  force_enhancement,
  // The fit.
  fit_poor,
  far_from_prior,
  unlike_person,
  several_modes,
  draws_unreliable,
  model_unfit,
  motion_alone,
  late_emg,
  lower_minimum,
  branches_differ,
  not_predicted,
  emg_delay_ignored,
  gain_mismatch,
  co_contraction_zeroed,
  count_of_codes,  ///< No code: the number of codes.
};
/// Returns "marker_gap", as in the documentation and --json.
[[nodiscard]] std::string_view name(RemarkCode code);

/// One thing that a person should know about an input or a result.
struct Remark {
  RemarkCode code = RemarkCode::general;
  Severity severity = Severity::warning;
  std::string where = {};  ///< Trial or file; empty: the whole study.
  /// Marker, EMG channel, "plate 1", coordinate; two of them as "A, B". Remarks of one code about
  /// one thing are alike; without such a thing remarks of equal words and remedy are.
  std::string about = {};
  std::optional<Stretch> when = {};
  std::optional<double> value = {};        ///< The measured size, in the unit of the code's limit.
  std::string says = {};                   ///< A plain sentence without its full stop.
  std::string remedy = {};                 ///< An instruction to the user, without its full stop.
  std::vector<std::string> likewise = {};  ///< Other places with a similar remark (`grouped`).
};

/// Returns "marker 'C7' ...; fill it (likewise in slow, fast)": the remark in one line.
[[nodiscard]] std::string sentence(const Remark& remark);

/// Returns the sentences of all remarks, or of the remarks of one severity.
[[nodiscard]] std::vector<std::string> sentences(const std::vector<Remark>& remarks, std::optional<Severity> only = {});

/// Remarks with a time are alike as well, or each keeps its own time.
enum class Times { kept, merged };

/// Joins remarks of equal code, severity and `about`: the first one names the places of the others. The order stays.
[[nodiscard]] std::vector<Remark> grouped(const std::vector<Remark>& remarks, Times times = Times::kept);

/// Joins remarks of one place and code whose sentences differ by the quoted name of `about` alone: the first one's
/// `says` names the others, "channel 'A' shows nothing (likewise 'B', 'C')". The order stays.
[[nodiscard]] std::vector<Remark> named_together(const std::vector<Remark>& remarks);

/// Sorts the worst first; the order stays otherwise.
void sort_by_severity(std::vector<Remark>& remarks);

}  // namespace myoid::inline ground
