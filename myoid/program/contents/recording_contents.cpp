#include "myoid/program/contents/recording_contents.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/clock_facts.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/json_array.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/recording/angle_file.h"
#include "myoid/recording/c3d/c3d_signals.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/recording/c3d_survey.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/recording/tables/result_units.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/trc_reader.h"

namespace myoid::program {

using ground::FileFormat;
using nlohmann::ordered_json;

namespace {

ordered_json repairs_json(const std::vector<Repair>& repairs) {
  return array_of(repairs, [](const Repair& r) { return recording::to_string(r); });
}

/// Returns a marker with the number of frames that lack it, if there are any.
ordered_json marker_json(const std::string& name, Eigen::Index missing) {
  ordered_json marker{{"name", name}};
  if (missing > 0) marker["missing_frames"] = missing;
  return marker;
}

/// Returns a channel with its unit and range as far as they are known.
ordered_json channel_json(const std::string& name, std::string_view unit, double low, double high) {
  ordered_json channel{{"name", name}};
  if (!unit.empty()) channel["unit"] = unit;
  if (std::isfinite(low) && std::isfinite(high)) {
    channel["lowest"] = low;
    channel["highest"] = high;
  }
  return channel;
}

/// Returns start, duration and rate if there are any; `of` precedes the keys of a second clock.
ordered_json clock_json(const ClockFacts& facts, std::string_view of = "") {
  ordered_json j;
  const auto add = [&](const char* key, const std::optional<double>& value) {
    if (value) j[fmt::format("{}{}", of, key)] = *value;
  };
  add("start_s", facts.start_s);
  add("duration_s", facts.duration_s);
  add("rate_hz", facts.rate_hz);
  return j;
}

ordered_json channels_json(const TimeSeries& series) {
  ordered_json list = ordered_json::array();
  for (std::size_t c = 0; c < series.channels().size(); ++c) {
    double low = kInfinity;
    double high = -kInfinity;
    Eigen::Index gaps = 0;
    for (const double v : series.values().col(static_cast<Eigen::Index>(c))) {
      if (std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      } else {
        ++gaps;
      }
    }
    const Unit unit = series.channels()[c].unit;
    ordered_json channel =
        channel_json(series.channels()[c].name, unit == Unit::dimensionless ? "" : symbol(unit), low, high);
    if (gaps > 0) channel["gaps"] = gaps;
    list.push_back(std::move(channel));
  }
  return list;
}

/// Returns a series whose clock is the file's own.
ordered_json series_json(const TimeSeries& series) {
  const ClockFacts facts = clock_facts(series.time_s());
  ordered_json j{{"samples", facts.samples}};
  j.update(clock_json(facts));
  if (facts.rate_hz) j["evenly_sampled"] = facts.even;
  j["channels"] = channels_json(series);
  return j;
}

ordered_json markers_json(const MarkerSeries& markers) {
  ordered_json j{{"frames", markers.frame_count()}};
  j.update(clock_json(clock_facts(markers.time_s)));
  j["markers"] = ordered_json::array();
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    Eigen::Index missing = 0;
    for (Eigen::Index f = 0; f < markers.frame_count(); ++f) missing += markers.missing(f, m) ? 1 : 0;
    j["markers"].push_back(marker_json(markers.names[at(m)], missing));
  }
  return j;
}

ordered_json trc_json(const std::filesystem::path& path) {
  const recording::MarkerFile file = recording::read_trc(path);
  ordered_json j{{"kind", "markers (.trc)"}, {"unit", file.unit}};
  j.update(markers_json(file.markers));
  j["repairs"] = repairs_json(file.repairs);
  return j;
}

ordered_json events_json(const std::vector<Event>& events) {
  return array_of(events, [](const Event& e) {
    ordered_json j{{"name", e.label.empty() ? "event" : e.label}, {"time_s", e.time_s}};
    if (!e.context.empty()) j["context"] = e.context;
    return j;
  });
}

/// Adds the upward direction and its sources in the file; "not known" without any, "contradictory"
/// where two sources disagree.
void add_up(const std::filesystem::path& path, const recording::C3dSurvey& survey, ordered_json& j) {
  recording::LaboratoryUp up;
  try {
    if (!survey.plates.empty() || recording::screen_up(survey.file)) up = recording::read_laboratory_up(path);
  } catch (const ReadError& error) {
    j["up"] = "contradictory";
    j["up_from"] = error.what();
    return;
  }
  j["up"] = up.up_L ? recording::axis_name(*up.up_L) : "not known";
  if (up.up_L) j["up_from"] = up.because;
}

/// Returns all statements of a C3D file, with its channels in the unit as written.
ordered_json c3d_json(const std::filesystem::path& path) {
  const recording::C3dSurvey survey = recording::survey_c3d(path);
  const recording::C3dFile& file = survey.file;
  const Eigen::Index frames = survey.frames;
  ordered_json j{{"kind", "C3D"},
                 {"processor", file.processor == recording::C3dProcessor::intel ? "Intel"
                               : file.processor == recording::C3dProcessor::dec ? "DEC"
                                                                                : "SGI"},
                 {"samples", file.integer ? "16-bit integers" : "32-bit reals"},
                 {"frames", frames},
                 {"first_frame", file.first_frame},
                 {"start_s", file.start_s()},
                 {"duration_s", static_cast<double>(frames - 1) / file.point_rate_hz},
                 {"rate_hz", file.point_rate_hz}};
  if (!file.point_labels.empty()) j["point_unit"] = file.point_unit;
  j["markers"] = ordered_json::array();
  std::vector<bool> is_marker(file.point_labels.size(), false);
  for (const Eigen::Index c : recording::marker_columns(file)) {
    is_marker[at(c)] = true;
    j["markers"].push_back(marker_json(file.point_labels[at(c)], survey.missing_frames[at(c)]));
  }
  j["other_points"] = ordered_json::array();
  for (std::size_t c = 0; c < is_marker.size(); ++c)
    if (!is_marker[c]) j["other_points"].push_back(file.point_labels[c]);
  if (!file.channels.empty()) j["analog_rate_hz"] = file.analog_rate_hz();
  j["channels"] = ordered_json::array();
  for (std::size_t c = 0; c < file.channels.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    j["channels"].push_back(
        channel_json(file.channels[c].name, file.channels[c].unit_text, survey.lowest[column], survey.highest[column]));
  }
  j["force_plates"] = ordered_json::array();
  for (std::size_t p = 0; p < survey.plates.size(); ++p) {
    j["force_plates"].push_back({{"name", fmt::format("plate {}", survey.plates[p].number)},
                                 {"type", survey.plates[p].type},
                                 {"largest_force_n", survey.largest_force_n[p]}});
  }
  add_up(path, survey, j);
  const recording::StatedBody body = recording::stated_body(file);
  if (body.mass_kg) j["body_mass_kg"] = *body.mass_kg;
  if (body.height_m) j["body_height_m"] = *body.height_m;
  j["events"] = events_json(file.events);
  j["repairs"] = repairs_json(survey.repairs);
  return j;
}

/// Returns markers, channels in SI, or both, each with its own clock. `series` names a file of channels alone.
ordered_json recording_json(const std::filesystem::path& path, const char* series) {
  const recording::Recording file = recording::read_recording(path);
  const bool has_markers = file.markers.marker_count() > 0;
  const bool has_channels = file.analog.channel_count() > 0;
  ordered_json j;
  if (has_markers) {
    j["kind"] = fmt::format("markers{} ({})", has_channels ? " and channels" : "", extension_of(path));
    j.update(markers_json(file.markers));
    if (has_channels) {
      const TimeSeries analog = file.analog.series();
      j["analog_samples"] = analog.sample_count();
      j.update(clock_json(clock_facts(analog.time_s()), "analog_"));
      j["channels"] = channels_json(analog);
    }
  } else {
    j["kind"] = series;
    j.update(series_json(file.analog.series()));
  }
  for (const AnalogChannels& other : file.other_clocks) j["other_clocks"].push_back(series_json(other.series()));
  j["events"] = events_json(file.events);
  j["repairs"] = repairs_json(file.repairs);
  return j;
}

ordered_json storage_json(const std::filesystem::path& path) {
  const recording::Storage file = recording::read_storage(path);
  ordered_json j{{"kind", "storage (.mot, .sto)"}, {"title", file.title}};
  if (const auto to_volt = recording::stated_voltage(file)) {
    j["emg_unit"] = recording::voltage_name(*to_volt);
  } else if (!recording::may_hold_angles(file)) {
    // inDegrees stands in every file of OpenSim.
  } else if (recording::states_degrees(file)) {
    j["angles"] = file.in_degrees ? "degrees" : "radians";
  } else if (file.in_degrees) {
    j["angles"] = "degrees";
    j["angles_from"] = "usage";  // the header does not say
  }
  j.update(series_json(file.data));
  j["repairs"] = repairs_json(file.repairs);
  return j;
}

ordered_json csv_json(const std::filesystem::path& path) {
  try {
    return recording_json(path, "time series (.csv)");
  } catch (const ReadError& error) {
    try {
      const recording::CsvTable table = recording::read_csv_table(path);
      return {{"kind", "table (.csv)"},
              {"rows", table.rows.size()},
              {"columns", table.names},
              {"no_recording", error.what()}};
    } catch (const ReadError&) {
      throw ReadError(error);  // a table of a known maker that is damaged, not one with rows of other widths
    }
  }
}

}  // namespace

std::optional<ordered_json> recording_contents(const std::filesystem::path& path) {
  const auto format = format_of(path);
  if (!format) return std::nullopt;
  switch (*format) {
    case FileFormat::c3d:
      return c3d_json(path);
    case FileFormat::trc:
      return trc_json(path);
    case FileFormat::storage:
      return storage_json(path);
    case FileFormat::text_table:
    case FileFormat::bids_motion:
      return csv_json(path);
    case FileFormat::edf:
      return recording_json(path, "EMG (.edf, .bdf)");
    case FileFormat::anc:
      return recording_json(path, "analog channels (.anc)");
    case FileFormat::mesh_vtp:
    case FileFormat::mesh_stl:
    case FileFormat::mesh_obj:
    case FileFormat::model:
    case FileFormat::set_up:
    case FileFormat::toml:
      break;
  }
  return std::nullopt;
}

}  // namespace myoid::program
