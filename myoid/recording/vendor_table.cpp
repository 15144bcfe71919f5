#include "myoid/recording/vendor_table.h"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace myoid::recording {
namespace {

using Lines = std::vector<std::string_view>;

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

std::vector<std::string> trimmed_cells(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (const std::string_view cell : split(line, separator)) cells.emplace_back(trim(cell));
  return cells;
}

std::string row_of(const std::vector<std::string>& cells, char separator) {
  std::string row;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c > 0) row += separator;
    row += cells[c];
  }
  return row;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

/// Nexus: "Devices", rate, devices, channels, units, rows, an empty line.
PlainTable vicon_rows(const Lines& lines) {
  std::size_t at = 0;
  while (at < lines.size() && !trim(lines[at]).starts_with("Devices")) ++at;
  if (at + 5 >= lines.size() ||
      trim(lines[at]).substr(7).find_first_not_of(",\t;") != std::string_view::npos)
    return {};
  const char separator = lines[at + 3].find('\t') != std::string_view::npos ? '\t' : ',';
  const auto rate = trimmed_cells(lines[at + 1], separator);
  const auto devices = trimmed_cells(lines[at + 2], separator);
  auto names = trimmed_cells(lines[at + 3], separator);
  const auto units = trimmed_cells(lines[at + 4], separator);
  if (rate.empty() || !parse_number(rate[0]) || names.empty() ||
      !equal_ignoring_case(names[0], "Frame"))
    return {};
  PlainTable table;
  std::vector<std::string> out(lines.size());
  out[at + 1] = fmt::format("Sampling rate: {} Hz", rate[0]);
  std::map<std::string, int> count;
  for (const std::string& name : names) ++count[name];
  std::string device;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (c < devices.size() && !devices[c].empty()) device = devices[c];
    if (c < 2) continue;
    const std::string name = count[names[c]] > 1 ? device + " " + names[c] : names[c];
    names[c] = with_unit(name, c < units.size() ? units[c] : "");
  }
  out[at + 4] = row_of(names, separator);
  std::size_t n = at + 5;
  for (; n < lines.size() && !trim(lines[n]).empty(); ++n) out[n] = std::string(lines[n]);
  out.resize(n);
  table.text = joined(out);
  table.repairs.push_back({at + 1, "the section 'Devices' is read"});
  return table;
}

/// Qualisys: CHANNEL_NAMES and no header row, or "SAMPLE" and "TIME" before the names.
PlainTable qualisys_rows(const Lines& lines) {
  if (lines.empty() || !trim(lines[0]).starts_with("NO_OF_SAMPLES")) return {};
  std::vector<std::string> out(lines.begin(), lines.end());
  std::vector<std::string> names;
  for (std::size_t n = 0; n < std::min<std::size_t>(lines.size(), 40); ++n) {
    const auto cells = trimmed_cells(lines[n], '\t');
    if (cells.empty()) continue;
    if (cells[0] == "CHANNEL_NAMES") {
      names.assign(cells.begin() + 1, cells.end());
      while (!names.empty() && names.back().empty()) names.pop_back();
    }
    if (equal_ignoring_case(cells[0], "SAMPLE")) return {};  // a header row of its own
    if (!names.empty() && parse_number(cells[0])) {
      if (n == 0) return {};
      out[n - 1] = row_of(names, '\t');
      for (std::size_t k = 0; k + 1 < n; ++k) {
        if (out[k].starts_with("CHANNEL_")) out[k].clear();
      }
      return {joined(out), {{n, "names are those of CHANNEL_NAMES"}}};
    }
  }
  return {};
}

/// BIOPAC: file, "0.5 msec/sample", "2 channels", name and unit of each, "CH1 CH2", counts, rows.
PlainTable biopac_rows(const Lines& lines) {
  if (lines.size() < 8) return {};
  const auto interval = split_words(lines[1]);
  const auto channels = split_words(lines[2]);
  if (interval.size() < 2 || channels.size() < 2 || !channels[1].starts_with("channel")) return {};
  const auto amount = parse_number(interval[0]);
  const auto count = parse_number(channels[0]);
  if (!amount || !(*amount > 0.0) || !count || !(*count >= 1.0 && *count <= 1000.0)) return {};
  std::optional<double> rate;
  if (interval[1] == "msec/sample") rate = 1e3 / *amount;
  if (interval[1] == "sec/sample") rate = 1.0 / *amount;
  if (interval[1] == "samples/second" || interval[1] == "samples/sec") rate = *amount;
  if (interval[1] == "kHz") rate = 1e3 * *amount;
  if (interval[1] == "Hz") rate = *amount;
  if (!rate) return {};
  const auto n_channels = static_cast<std::size_t>(*count);
  const std::size_t header = 3 + 2 * n_channels;
  if (header + 1 >= lines.size()) return {};
  const char separator = lines[header].find('\t') != std::string_view::npos ? '\t' : ',';
  auto names = trimmed_cells(lines[header], separator);
  while (!names.empty() && names.back().empty()) names.pop_back();
  // A column of times before the channels, in any unit: the interval says the same more exactly.
  const std::size_t before = names.size() - std::min(names.size(), n_channels);
  if (names.size() < n_channels || before > 1) return {};
  for (std::size_t c = 0; c < names.size(); ++c) {
    names[c] = c < before ? "Sample"
                          : with_unit(std::string(trim(lines[3 + 2 * (c - before)])),
                                      std::string(trim(lines[4 + 2 * (c - before)])));
  }
  std::vector<std::string> out(lines.size());
  out[1] = fmt::format("Sampling rate: {} Hz", *rate);
  out[header + 1] = row_of(names, separator);
  for (std::size_t n = header + 2; n < lines.size(); ++n) {
    std::string_view line = trim(lines[n]);
    while (line.ends_with(separator)) line.remove_suffix(1);
    out[n] = std::string(line);
  }
  return {joined(out), {{2, fmt::format("{} Hz, names and units from the header", *rate)}}};
}

/// BTS: "Measure unit:" for all tracks.
PlainTable bts_rows(const Lines& lines) {
  if (lines.empty() || !trim(lines[0]).starts_with("BTS ASCII")) return {};
  std::vector<std::string> out(lines.begin(), lines.end());
  std::string unit;
  for (std::size_t n = 1; n < std::min<std::size_t>(lines.size(), 40); ++n) {
    auto cells = trimmed_cells(lines[n], '\t');
    if (cells.size() > 1 && cells[0] == "Measure unit:") unit = cells[1];
    if (cells.empty() || !equal_ignoring_case(cells[0], "Frame")) continue;
    for (std::size_t c = 1; c < cells.size(); ++c) {
      if (!cells[c].empty() && !equal_ignoring_case(cells[c], "Time"))
        cells[c] = with_unit(cells[c], unit);
    }
    out[n] = row_of(cells, '\t');
    out[0].clear();
    return {joined(out), {}};
  }
  return {};
}

}  // namespace

PlainTable plain_vendor_table(std::string_view text) {
  const Lines lines = split_lines(text);
  for (const auto& known : {vicon_rows, qualisys_rows, biopac_rows, bts_rows}) {
    PlainTable table = known(lines);
    if (table.text.empty()) continue;
    // A last row that is cut off stays recognizable.
    if (!ends_with_line(text) && table.text.ends_with('\n')) table.text.pop_back();
    return table;
  }
  return {};
}

}  // namespace myoid::recording
