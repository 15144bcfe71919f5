#include "myoid/signals/quality_limits.h"

#include <fmt/format.h>

namespace myoid::signals {

std::vector<LimitRow> limit_rows(const QualityLimits& l) {
  using enum RemarkCode;
  return {
      {marker_unit, "a factor of 5 or more"},
      {marker_gap, fmt::format("{} s, {:g} % of the frames", l.gap_s, 100.0 * l.missing_share)},
      {marker_jump, fmt::format("{:g} mm", 1000.0 * l.jump_m)},
      {marker_swap, fmt::format("{:g} mm apart", 1000.0 * l.swap_m)},
      {segment_not_rigid, fmt::format("{:g} mm and {:g} %", 1000.0 * l.rigid_m, 100.0 * l.rigid_share)},
      {emg_amplitude, fmt::format("{:g} V", l.amplitude_v)},
      {emg_envelope, fmt::format("{:g} times a second", l.raw_hz)},
      {emg_flat, fmt::format("{} s, {:g} uV rms", l.flat_s, 1e6 * l.flat_v)},
      {emg_clipped, fmt::format("{:g} % of the samples", 100.0 * l.clipped_share)},
      {emg_saturated, fmt::format("{} s", l.saturated_s)},
      {emg_hum, fmt::format("{:g} % of the power", 100.0 * l.hum_share)},
      {emg_low_signal, fmt::format("ratio {:g}", l.signal_to_rest)},
      {emg_crosstalk, fmt::format("correlation {}", l.crosstalk)},
      {emg_drift, fmt::format("ratio {:g}", l.drift_over_rms)},
      {emg_artifact, fmt::format("ratio {:g}", l.artifact_over_rms)},
      {emg_over_reference, fmt::format("ratio {}; {:g} in all channels", l.over_reference, l.other_unit)},
      {clock_uneven, fmt::format("{:g} %", 100.0 * l.uneven_share)},
      {clock_offset, fmt::format("{} to {:g} s", l.earliest_offset_s, l.latest_offset_s)},
      {clock_drift, fmt::format("{} s", l.drift_s)},
      {plate_offset, fmt::format("{:g} N", l.plate_offset_n)},
      {plate_sign, "any"},
      {plate_pressure_outside, fmt::format("{:g} mm, {:g} % of the time above {:g} N", 1000.0 * l.plate_margin_m,
                                           100.0 * l.plate_outside_share, l.plate_loaded_n)},
  };
}

}  // namespace myoid::signals
