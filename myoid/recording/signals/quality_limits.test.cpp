#include "myoid/recording/signals/quality_limits.h"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/remark.h"

#include "tests/support/places.h"
#include "tests/support/printed_page.h"

namespace myoid::recording {
namespace {

/// One row of the documented table.
struct LimitRow {
  RemarkCode code;
  std::string limit;  ///< As the documentation writes it: "0.2 s".
};

/// Returns the limits as text, every fault once, in the order of RemarkCode.
std::vector<LimitRow> limit_rows(const QualityLimits& l) {
  using enum RemarkCode;
  return {
      {marker_unit, "a factor of 5 or more"},
      {marker_gap, fmt::format("{} s, {:g} % of the frames", l.markers.gap_s, 100.0 * l.markers.missing_share)},
      {marker_jump, fmt::format("{:g} mm", 1000.0 * l.markers.jump_m)},
      {marker_swap, fmt::format("{:g} mm apart", 1000.0 * l.markers.swap_m)},
      {segment_not_rigid, fmt::format("{:g} mm and {:g} %", 1000.0 * l.markers.rigid_m, 100.0 * l.markers.rigid_share)},
      {emg_amplitude, fmt::format("{:g} V, {:g} % of the samples", l.emg.amplitude_v, 100.0 * l.emg.amplitude_share)},
      {emg_envelope, fmt::format("{:g} times a second; {:g} % near zero", l.emg.raw_hz, 100.0 * l.emg.rectified_share)},
      {emg_flat, fmt::format("{} s, {:g} uV rms", l.emg.flat_s, 1e6 * l.emg.flat_v)},
      {emg_clipped, fmt::format("{:g} % of the samples", 100.0 * l.emg.clipped_share)},
      {emg_saturated, fmt::format("{} s", l.emg.saturated_s)},
      {emg_hum, fmt::format("{:g} % of the power", 100.0 * l.emg.hum_share)},
      {emg_low_signal, fmt::format("ratio {:g}; {:g}, {:g}, {:g} uV and flatness {:g} of noise", l.emg.signal_to_rest,
                                   l.noise.rises, l.noise.level, 1e6 * l.noise.rms_v, l.noise.flatness)},
      {emg_crosstalk, fmt::format("correlation {}", l.emg.crosstalk)},
      {emg_drift, fmt::format("ratio {:g}", l.emg.drift_over_rms)},
      {emg_artifact,
       fmt::format("ratio {:g}; spikes of {:g} ms and ratio {:g}; heart {:g}, {:g} %", l.emg.artifact_over_rms,
                   1000.0 * l.emg.spike_s, l.emg.spike_over_emg, l.emg.ecg_alike, 100.0 * l.emg.ecg_irregular)},
      {emg_over_reference,
       fmt::format("ratio {}; {:g} in all channels; {:g} alone, {:g} at an end", l.levels.over_reference,
                   l.levels.other_unit, l.levels.lone_reference, l.levels.lone_reference_at_end)},
      {emg_gain, fmt::format("ratio {:g}, {:g} of one channel, alike within a factor of {:g}", l.levels.gain,
                             l.levels.gain_alone, l.levels.gain_alike)},
      {emg_offset, fmt::format("ratio {:g}", l.levels.offset)},
      {clock_uneven, fmt::format("{:g} %", 100.0 * l.clocks.uneven_share)},
      {clock_offset, fmt::format("{} to {:g} s", l.clocks.earliest_offset_s, l.clocks.latest_offset_s)},
      {clock_drift, fmt::format("{} s", l.clocks.drift_s)},
      {plate_offset, fmt::format("{:g} N", l.plates.offset_n)},
      {plate_sign, "any"},
      {plate_pressure_outside, fmt::format("{:g} mm, {:g} % of the time above {:g} N", 1000.0 * l.plates.margin_m,
                                           100.0 * l.plates.outside_share, l.plates.loaded_n)},
  };
}

TEST(QualityLimits, AreTheOnesThatTheDocumentationLists) {
  std::ifstream stream(test::source_dir() / "docs/guide/check.md");
  std::stringstream text;
  text << stream.rdbuf();
  const std::vector<LimitRow> rows = limit_rows({});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(rows[i].code), i);
    const std::string begin = fmt::format("| `{}` | {} |", name(rows[i].code), rows[i].limit);
    EXPECT_NE(text.str().find(begin), std::string::npos) << "no row " << begin;
  }
  // The last kind has the last row.
  EXPECT_EQ(rows.back().code, RemarkCode::plate_pressure_outside);
}

TEST(QualityLimits, EveryOneIsInARow) {
  test::expect_all_printed<QualityLimits>([](const QualityLimits& limits) {
    std::string text;
    for (const LimitRow& row : limit_rows(limits)) text += row.limit + "\n";
    return text;
  });
}

}  // namespace
}  // namespace myoid::recording
