#include "myoid/tables/trc_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"

namespace myoid::recording {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// Key line and value line of the header as pairs: word by word where there are as many values as
/// keys, however they are separated (real files have two tabs between values), else cell by cell.
std::map<std::string, std::string> read_header(std::string_view keys,
                                               std::string_view values,
                                               char separator) {
  std::map<std::string, std::string> header;
  auto names = separator == ',' ? split(keys, separator) : split_words(keys);
  auto cells = separator == ',' ? split(values, separator) : split_words(values);
  if (names.size() != cells.size()) {
    names = split(keys, separator);
    cells = split(values, separator);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const auto name = trim(names[i]); !name.empty()) {
      header[std::string(name)] = i < cells.size() ? std::string(trim(cells[i])) : "";
    }
  }
  return header;
}

/// How many markers stand in the columns behind Frame# and Time: by the line X1 Y1 Z1 ..., else by
/// the filled cells of the first row.
std::size_t markers_in_columns(const std::vector<std::string_view>& lines, char separator) {
  const auto axes = split_words(lines[4]);
  if (!axes.empty() && axes.front().starts_with('X') && axes.size() % 3 == 0)
    return axes.size() / 3;
  for (std::size_t n = 4; n < lines.size(); ++n) {
    auto cells = split(lines[n], separator);
    while (!cells.empty() && trim(cells.back()).empty()) cells.pop_back();
    if (cells.size() >= 2 && parse_number(cells[0]))
      return cells.size() / 3;  // (cells - 2) / 3, rounded up
  }
  return 0;
}

/// The names of the label line, each over the first of its marker's three columns, where fewer than
/// `count` stand there: an empty one for every marker without a name. Empty if they stand
/// elsewhere.
std::vector<std::string> names_over_columns(const std::vector<std::string_view>& cells,
                                            std::size_t count) {
  std::vector<std::string> names(count);
  for (std::size_t c = 2; c < cells.size(); ++c) {
    if (trim(cells[c]).empty()) continue;
    if ((c - 2) % 3 != 0 || (c - 2) / 3 >= count) return {};
    names[(c - 2) / 3] = trim(cells[c]);
  }
  return names;
}

/// The label line without Frame# and Time. Throws ReadError if its second word is no time.
std::vector<std::string> label_words(std::string_view line,
                                     char separator,
                                     const std::filesystem::path& path,
                                     std::size_t number,
                                     std::vector<Repair>& repairs) {
  std::vector<std::string> names;
  std::size_t word = 0;
  for (const std::string_view cell : split(line, separator)) {
    const std::string_view name = trim(cell);
    if (name.empty()) continue;
    if (++word <= 2) {
      if (word == 2 && !equal_ignoring_case(name.substr(0, 4), "time")) {
        throw ReadError(path, number,
                        fmt::format("expected the second column to be 'Time', found '{}'", name));
      }
      if (word == 2 && name != "Time")
        repairs.push_back({number, fmt::format("column '{}' read as 'Time'", name)});
      continue;
    }
    names.emplace_back(name);
  }
  return names;
}

/// Marker names, one for each three columns: every word of the label line wherever the tabs stand,
/// and made-up ones for markers that have none.
std::vector<std::string> read_names(const std::vector<std::string_view>& lines,
                                    char separator,
                                    const std::filesystem::path& path,
                                    std::vector<Repair>& repairs) {
  constexpr std::size_t kNumber = 4;
  auto names = label_words(lines[kNumber - 1], separator, path, kNumber, repairs);
  const std::size_t count = markers_in_columns(lines, separator);
  if (names.size() < count) {
    auto placed = names_over_columns(split(lines[kNumber - 1], separator), count);
    if (!placed.empty()) names = std::move(placed);
  }
  std::size_t made_up = 0;
  std::set<std::string> seen;
  for (std::size_t m = 0; m < names.size(); ++m) {
    if (names[m].empty()) {
      names[m] = fmt::format("marker_{}", m + 1);
      ++made_up;
    }
    const std::string name = names[m];
    for (int k = 2; !seen.insert(names[m]).second; ++k) {
      names[m] = fmt::format("{}_{}", name, k);
      repairs.push_back(
          {kNumber,
           fmt::format("two markers are named '{}'; the later one is '{}' here", name, names[m])});
    }
  }
  if (made_up > 0)
    repairs.push_back({kNumber, fmt::format("{} of {} markers have no name; called 'marker_N' by "
                                            "their place, marker 1 in the columns behind Time",
                                            made_up, names.size())});
  return names;
}

}  // namespace

TrcFile parse_trc(std::string_view text, const std::filesystem::path& path) {
  const std::vector<std::string_view> lines = split_lines(text);
  if (lines.empty() || !trim(lines[0]).starts_with("PathFileType")) {
    throw ReadError(
        path, 1,
        fmt::format(
            "expected 'PathFileType' as the first word, found '{}'; this is not a .trc file",
            lines.empty() ? "" : trim(lines[0]).substr(0, 40)));
  }
  if (lines.size() < 5)
    throw ReadError(path, lines.size(), "the file is cut off: its header has five lines");
  TrcFile file;
  const char separator =
      lines[1].find('\t') == std::string_view::npos && lines[1].find(',') != std::string_view::npos
          ? ','
          : '\t';
  if (separator == ',') file.repairs.push_back({2, "separated by commas instead of tabs"});
  const auto header = read_header(lines[1], lines[2], separator);
  const auto field = [&](const std::string& key) {
    const auto it = header.find(key);
    return it == header.end() ? std::string() : it->second;
  };
  file.unit = field("Units");
  const auto unit = parse_unit(file.unit);
  if (!unit || unit->unit != Unit::meter) {
    throw ReadError(
        path, 3, fmt::format("Units: found '{}', expected mm or m; correct the header", file.unit));
  }
  file.rate_hz = parse_number(field("DataRate")).value_or(0.0);
  MarkerSeries& markers = file.markers;
  markers.names = read_names(lines, separator, path, file.repairs);
  if (markers.names.empty()) throw ReadError(path, 4, "there are no markers after Frame# and Time");
  if (const auto said = parse_number(field("NumMarkers"));
      said && *said != static_cast<double>(markers.names.size())) {
    file.repairs.push_back(
        {3, fmt::format("the header says {} markers, there are {}", *said, markers.names.size())});
  }
  if (trim(lines[4]).starts_with("X0")) file.repairs.push_back({5, "coordinates numbered from 0"});

  // Some exporters leave out the line X1 Y1 Z1 ...: then the fifth line is a frame already.
  const auto fifth = split(lines[4], separator);
  const bool no_axes = fifth.size() > 2 && parse_number(fifth[0]) && parse_number(fifth[1]);
  if (no_axes) file.repairs.push_back({5, "the line X1 Y1 Z1 ... is missing"});

  const std::size_t width = 3 * markers.names.size();
  std::vector<double> time;
  Eigen::MatrixXd values(static_cast<Eigen::Index>(lines.size()), static_cast<Eigen::Index>(width));
  std::size_t zero_line = 0;
  std::size_t repeated_line = 0;
  std::size_t short_line = 0;
  std::size_t surplus_line = 0;
  std::size_t comma_line = 0;
  std::size_t partial_line = 0;
  const auto frames_said = parse_number(field("NumFrames"));
  const auto number_of = [&](std::string_view cell, std::size_t line) {
    auto number = parse_number(cell);
    if (!number && separator != ',') {
      number = parse_comma_number(cell);
      if (number && comma_line == 0) comma_line = line;
    }
    return number;
  };
  for (std::size_t n = no_axes ? 4 : 5; n < lines.size(); ++n) {
    if (trim(lines[n]).empty()) continue;
    if (lines[n].find_first_not_of(" \t,\r") == std::string_view::npos) continue;
    const auto cells = split(lines[n], separator);
    if (n + 1 == lines.size() && !ends_with_line(text)) {
      const bool complete = frames_said && *frames_said == static_cast<double>(time.size() + 1) &&
                            cells.size() >= width + 2 && !looks_cut(lines[n], lines[n - 1]);
      if (!complete && !time.empty()) {
        file.repairs.push_back({n + 1, std::string(kLastRowLeftOut)});
        break;
      }
      file.repairs.push_back({n + 1, std::string(kLastRowKept)});
    }
    if (cells.size() < 2)
      throw ReadError(path, n + 1,
                      fmt::format("expected frame, time and {} coordinates, found '{}'", width,
                                  trim(lines[n])));
    const auto now = number_of(cells[1], n + 1);
    if (!now || !std::isfinite(*now))
      throw ReadError(path, n + 1,
                      fmt::format("expected the time as a number, found '{}'", trim(cells[1])));
    if (!time.empty() && *now <= time.back()) {
      if (*now < time.back()) {
        throw ReadError(
            path, n + 1,
            fmt::format("time goes backwards: {} s after {} s; sort the rows or split the file",
                        *now, time.back()));
      }
      if (repeated_line == 0) repeated_line = n + 1;
      continue;
    }
    if (cells.size() < width + 2) {
      if (n + 1 == lines.size()) {
        // The last row of a file that was cut off: its last number may be cut off too.
        file.repairs.push_back(
            {n + 1, fmt::format("the last row has {} of {} cells and is left out", cells.size(),
                                width + 2)});
        break;
      }
      if (short_line == 0) short_line = n + 1;
    }
    const auto row = static_cast<Eigen::Index>(time.size());
    for (std::size_t c = 0; c < width; ++c) {
      double value = kGap;
      if (c + 2 < cells.size()) {
        const std::string_view cell = trim(cells[c + 2]);
        if (!cell.empty()) {
          const auto number = number_of(cell, n + 1);
          if (!number) {
            throw ReadError(path, n + 1,
                            fmt::format("expected a number for {} of marker '{}', found '{}'",
                                        "XYZ"[c % 3], markers.names[c / 3], cell));
          }
          value = *number * unit->to_si;
        }
      }
      values(row, static_cast<Eigen::Index>(c)) = value;
    }
    for (std::size_t m = 0; m < markers.names.size(); ++m) {
      auto position = values.block<1, 3>(row, static_cast<Eigen::Index>(3 * m));
      const bool zero = (position.array() == 0.0).all();
      if (zero && zero_line == 0) zero_line = n + 1;
      if (position.hasNaN() && !position.array().isNaN().all() && partial_line == 0)
        partial_line = n + 1;
      if (zero || !position.allFinite()) position.setConstant(kGap);
    }
    for (std::size_t c = width + 2; c < cells.size() && surplus_line == 0; ++c) {
      if (!trim(cells[c]).empty()) surplus_line = n + 1;
    }
    time.push_back(*now);
  }
  if (time.empty())
    throw ReadError(path, lines.size(),
                    "there are no frames after the header; export the file again");
  if (zero_line > 0)
    file.repairs.push_back({zero_line, "a marker at exactly 0 0 0 is taken as missing"});
  if (comma_line > 0) file.repairs.push_back({comma_line, "comma decimals read as decimal points"});
  if (short_line > 0)
    file.repairs.push_back(
        {short_line, "a row ends early; the markers behind its end are taken as missing"});
  if (partial_line > 0)
    file.repairs.push_back(
        {partial_line, "a marker has only some of its coordinates; taken as missing"});
  if (surplus_line > 0)
    file.repairs.push_back(
        {surplus_line, "a row has more numbers than there are markers; the surplus is ignored"});
  if (repeated_line > 0)
    file.repairs.push_back({repeated_line, "a time stands twice; the first row is kept"});
  const auto frames = static_cast<Eigen::Index>(time.size());
  if (frames_said && *frames_said != static_cast<double>(frames)) {
    file.repairs.push_back(
        {3, fmt::format("the header says {} frames, there are {}", *frames_said, frames)});
  }
  const double rate = frames < 2 ? 0.0 : static_cast<double>(frames - 1) / (time.back() - time[0]);
  if (rate > 0.0 && file.rate_hz > 0.0 && std::abs(rate - file.rate_hz) > 0.05 * file.rate_hz) {
    file.repairs.push_back({3, fmt::format("the header says {} Hz, the times {:.6g} Hz; the times "
                                           "are taken",
                                           file.rate_hz, rate)});
  }
  markers.time_s = Eigen::Map<const Eigen::VectorXd>(time.data(), frames);
  markers.positions_m = values.topRows(frames);
  return file;
}

TrcFile read_trc(const std::filesystem::path& path) {
  return parse_trc(read_text_file(path), path);
}

}  // namespace myoid::recording
