#pragma once

#include <string>
#include <string_view>

namespace myoid {

/// What can be wrong with a recording. The documentation of `myoid check` has one row for each.
enum class FaultKind {
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
  clock_uneven,
  clock_offset,
  clock_drift,
  plate_offset,
  plate_sign,
  plate_pressure_outside,
};

/// One fault of one channel: where, when, by how much, and what to do.
struct Fault {
  FaultKind kind = FaultKind::marker_gap;
  bool grave = true;    ///< May make a result wrong: a warning. False: good to know.
  std::string channel;  ///< Marker, EMG channel, "plate 1"; two of them as "A, B".
  double begin_s = 0.0;
  double end_s = 0.0;
  double value = 0.0;  ///< What was found, in the unit of the kind's limit.
  std::string text;    ///< A plain sentence without its full stop; begins with the channel.
  std::string remedy;  ///< What to do, likewise.
};

/// "marker_gap", as the documentation and --json have it.
[[nodiscard]] std::string_view name(FaultKind kind);

/// "marker 'C7' ...; fill it" in one line.
[[nodiscard]] std::string sentence(const Fault& fault);

}  // namespace myoid
