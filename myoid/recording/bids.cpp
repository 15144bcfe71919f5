#include "myoid/recording/bids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/tables/table_clock.h"
#include "myoid/recording/tables/text_table.h"

namespace myoid::recording {
namespace {

/// Returns "sub-01_task-elbow" for "sub-01_task-elbow_emg.edf".
std::string stem_without_suffix(const std::filesystem::path& data) {
  const std::string stem = data.stem().string();
  const std::size_t bar = stem.rfind('_');
  return bar == std::string::npos ? std::string() : stem.substr(0, bar);
}

std::string cell_text(std::string_view cell) {
  const std::string text = to_utf8(trim(cell));
  return text == "n/a" ? std::string() : text;
}

std::vector<BidsChannel> read_channels(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  const auto lines = split_lines(text);
  std::map<std::string, std::size_t> column;
  const auto head = split(lines.empty() ? std::string_view() : lines[0], '\t');
  for (std::size_t c = 0; c < head.size(); ++c) column.try_emplace(cell_text(head[c]), c);
  for (const char* required : {"name", "type", "units"}) {
    if (!column.contains(required))
      throw ReadError(path, 1, "there is no column '{}', which every _channels.tsv has", required);
  }
  std::vector<BidsChannel> channels;
  for (std::size_t n = 1; n < lines.size(); ++n) {
    if (trim(lines[n]).empty()) continue;
    const auto cells = split(lines[n], '\t');
    const auto value = [&](const char* name) {
      const auto it = column.find(name);
      return it != column.end() && it->second < cells.size() ? cell_text(cells[it->second]) : std::string();
    };
    BidsChannel channel{value("name"),
                        value("type"),
                        value("units"),
                        value("component"),
                        value("tracked_point"),
                        value("target_muscle"),
                        equal_ignoring_case(value("status"), "bad"),
                        parse_number(value("sampling_frequency")).value_or(0.0)};
    if (channel.name.empty()) throw ReadError(path, n + 1, "the channel has no name");
    channels.push_back(std::move(channel));
  }
  if (channels.empty()) throw ReadError(path, 0, "there are no channels below the header");
  return channels;
}

/// Reads the rows of a `_motion.tsv`: no header, one column a channel.
TableNumbers motion_rows(const std::filesystem::path& path, const std::vector<BidsChannel>& channels) {
  const std::string text = read_text_file(path);
  TableRows rows;
  rows.separator = '\t';
  rows.empty_row_is_gap = true;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    rows.names.push_back(channels[c].name);
    rows.values.push_back(c);
  }
  const TableText table(text);
  rows.end = table.lines.size();
  return read_rows(table, rows, path);
}

/// Returns SamplingFrequency of a sidecar.
double rate_of(const std::filesystem::path& path) {
  const auto json = parse_json(read_text_file(path), false);
  if (!json.is_object()) throw ReadError(path, 0, "this is no JSON object");
  const auto it = json.find("SamplingFrequency");
  const double rate = it != json.end() && it->is_number() ? it->get<double>() : 0.0;
  if (!(rate > 0.0 && rate < 1e7))
    throw ReadError(path, 0, "SamplingFrequency [Hz] is missing; the sidecar of motion data needs it");
  return rate;
}

/// Returns the channel's factor to SI. Throws ReadError unless its unit is one of `expected`.
double to_si(const BidsChannel& channel, Unit expected, const std::filesystem::path& path) {
  const auto unit = parse_file_unit(channel.unit);
  if (!unit || unit->unit != expected)
    throw ReadError(path, 0, "channel '{}' of type {}: its unit '{}' is not one of [{}]", channel.name, channel.type,
                    channel.unit, symbol(expected));
  return unit->to_si;
}

/// Returns the times [s] of the rows: their latencies, else those of the rate.
Eigen::VectorXd times_of(const std::vector<BidsChannel>& channels,
                         const TableNumbers& numbers,
                         double rate_hz,
                         const std::filesystem::path& path,
                         std::vector<Repair>& repairs) {
  const Eigen::Index last = numbers.values.rows() - 1;
  const auto other = [&](double said_hz, double taken_hz) {
    constexpr double kOther = 0.01;
    if (std::abs(said_hz - taken_hz) > kOther * taken_hz)
      repairs.push_back(other_rate(0, said_hz, taken_hz, static_cast<double>(last)));
  };
  const auto stated = std::ranges::find_if(channels, [](const BidsChannel& channel) { return channel.rate_hz > 0.0; });
  const double stated_hz = stated == channels.end() ? rate_hz : stated->rate_hz;
  const auto latency = std::ranges::find_if(
      channels, [](const BidsChannel& channel) { return equal_ignoring_case(channel.type, "LATENCY"); });
  if (latency == channels.end()) {
    other(stated_hz, rate_hz);
    return Eigen::VectorXd::LinSpaced(last + 1, 0.0, static_cast<double>(last)) / rate_hz;
  }
  const double unit_s = latency->unit.empty() ? 1.0 : to_si(*latency, Unit::second, path);
  Eigen::VectorXd time_s = unit_s * numbers.values.col(latency - channels.begin());
  for (Eigen::Index i = 0; i <= last; ++i)
    if (!std::isfinite(time_s[i]) || (i > 0 && time_s[i] <= time_s[i - 1]))
      throw ReadError(path, numbers.lines[static_cast<std::size_t>(i)], "the latency does not increase: sort the rows");
  if (last == 0) return time_s;
  const double taken_hz = static_cast<double>(last) / (time_s[last] - time_s[0]);
  other(rate_hz, taken_hz);
  if (stated_hz != rate_hz) other(stated_hz, taken_hz);
  return time_s;
}

/// A tracked point with the columns of its x, y and z.
struct Point {
  std::string name;
  std::array<std::optional<std::size_t>, 3> columns;
};

/// The use of each column of a `_motion.tsv`.
struct MotionColumns {
  std::vector<Point> points;
  std::vector<std::size_t> angles;
  std::size_t others = 0;
};

MotionColumns motion_columns(const std::vector<BidsChannel>& channels) {
  MotionColumns columns;
  std::map<std::string, std::size_t> place;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const BidsChannel& channel = channels[c];
    const std::size_t axis = channel.component.size() == 1
                                 ? std::string_view("xyz").find(static_cast<char>(channel.component[0] | 0x20))
                                 : std::string_view::npos;
    if (equal_ignoring_case(channel.type, "POS") && axis < 3) {
      const std::string& name = channel.tracked_point.empty() ? channel.name : channel.tracked_point;
      const auto [it, is_new] = place.try_emplace(name, columns.points.size());
      if (is_new) columns.points.push_back({name, {}});
      columns.points[it->second].columns[axis] = c;
    } else if (equal_ignoring_case(channel.type, "JNTANG")) {
      columns.angles.push_back(c);
    } else if (!equal_ignoring_case(channel.type, "LATENCY")) {
      ++columns.others;
    }
  }
  return columns;
}

/// Returns the points that have x, y and z, in meters; a frame without one of them is a gap of the point.
MarkerSeries markers_of(const std::vector<Point>& points,
                        const std::vector<BidsChannel>& channels,
                        const Eigen::VectorXd& time_s,
                        const Eigen::MatrixXd& values,
                        const std::filesystem::path& path,
                        std::vector<Repair>& repairs) {
  MarkerSeries markers;
  markers.time_s = time_s;
  Eigen::MatrixXd positions(values.rows(), static_cast<Eigen::Index>(3 * points.size()));
  Eigen::Index width = 0;
  for (const Point& point : points) {
    if (!point.columns[0] || !point.columns[1] || !point.columns[2]) {
      note(repairs, "point '{}' does not have x, y and z; left out", point.name);
      continue;
    }
    markers.names.push_back(point.name);
    for (const auto& column : point.columns)
      positions.col(width++) =
          to_si(channels[*column], Unit::meter, path) * values.col(static_cast<Eigen::Index>(*column));
  }
  markers.positions_m = positions.leftCols(width);
  for (Eigen::Index k = 0; k < values.rows(); ++k) {
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      if (markers.missing(k, m)) markers.positions_m.block<1, 3>(k, 3 * m).setConstant(kNan);
    }
  }
  return markers;
}

TimeSeries angles_of(const std::vector<std::size_t>& columns,
                     const std::vector<BidsChannel>& channels,
                     const Eigen::VectorXd& time_s,
                     const Eigen::MatrixXd& values,
                     const std::filesystem::path& path) {
  if (columns.empty()) return {};
  std::vector<Channel> named;
  Eigen::MatrixXd angles(values.rows(), static_cast<Eigen::Index>(columns.size()));
  for (const std::size_t column : columns) {
    angles.col(static_cast<Eigen::Index>(named.size())) =
        to_si(channels[column], Unit::radian, path) * values.col(static_cast<Eigen::Index>(column));
    named.push_back({channels[column].name, Unit::radian});
  }
  try {
    return {time_s, std::move(named), std::move(angles)};
  } catch (const InvalidInput& error) {
    throw ReadError(path, 0, error.what());
  }
}

}  // namespace

std::optional<std::vector<BidsChannel>> bids_channels_of(const std::filesystem::path& data) {
  const std::string stem = stem_without_suffix(data);
  const auto path = data.parent_path() / (stem + "_channels.tsv");
  std::error_code ignored;  // a name that no file can have does not exist
  if (stem.empty() || !std::filesystem::exists(path, ignored)) return std::nullopt;
  return read_channels(path);
}

BidsMotion read_bids_motion(const std::filesystem::path& path) {
  const auto channels = bids_channels_of(path);
  if (!channels) {
    throw ReadError(path, 0, "motion data need '{}_channels.tsv' beside them: it names the columns",
                    stem_without_suffix(path));
  }
  const double rate = rate_of(std::filesystem::path(path).replace_extension(".json"));
  TableNumbers numbers = motion_rows(path, *channels);
  BidsMotion motion;
  motion.repairs = std::move(numbers.repairs);
  const Eigen::VectorXd time = times_of(*channels, numbers, rate, path, motion.repairs);
  const MotionColumns columns = motion_columns(*channels);
  if (columns.others > 0)
    note(motion.repairs, "{} channels are neither positions nor joint angles; left out", columns.others);
  motion.angles = angles_of(columns.angles, *channels, time, numbers.values, path);
  motion.markers = markers_of(columns.points, *channels, time, numbers.values, path, motion.repairs);
  if (motion.markers.names.empty()) {
    motion.markers = {};
    if (motion.angles.empty()) throw ReadError(path, 0, "no channel is a position (POS) or a joint angle (JNTANG)");
  }
  return motion;
}

}  // namespace myoid::recording
