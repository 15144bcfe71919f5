#include "myoid/recording/marker_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/c3d_file.h"

namespace myoid::recording {
namespace {

using Lines = std::vector<std::string_view>;

std::vector<std::string> unquoted_cells(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (const std::string_view part : split(line, separator)) {
    std::string_view cell = trim(part);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
      cell = trim(cell.substr(1, cell.size() - 2));
    cells.push_back(to_utf8(cell));
  }
  return cells;
}

/// Where the numbers of a table stand and what they are.
struct MarkerLayout {
  char separator = ',';
  std::vector<std::string> names;
  std::size_t first_column = 0;             ///< Of the first marker.
  std::vector<std::size_t> columns;         ///< Of each marker, where other columns stand between.
  std::optional<std::size_t> frame_column;  ///< Counts from 1.
  std::optional<std::size_t> time_column;   ///< [s]
  std::size_t first_row = 0, end_row = 0;
  double rate_hz = 0.0;
  std::string unit;
  bool zero_is_missing = false;
};

std::optional<double> number_behind(const Lines& lines, std::size_t most, std::string_view word) {
  for (std::size_t n = 0; n < std::min(most, lines.size()); ++n) {
    for (std::size_t at = 0; at + word.size() <= lines[n].size(); ++at) {
      if (!equal_ignoring_case(lines[n].substr(at, word.size()), word)) continue;
      std::size_t i = at + word.size();
      while (i < lines[n].size() && (lines[n][i] < '0' || lines[n][i] > '9')) ++i;
      std::size_t end = i;
      while (end < lines[n].size() &&
             ((lines[n][end] >= '0' && lines[n][end] <= '9') || lines[n][end] == '.'))
        ++end;
      if (const auto value = parse_number(lines[n].substr(i, end - i))) return value;
    }
  }
  return std::nullopt;
}

/// The text behind a word, up to the next separator.
std::string text_behind(const Lines& lines,
                        std::size_t most,
                        std::string_view word,
                        char separator) {
  for (std::size_t n = 0; n < std::min(most, lines.size()); ++n) {
    const auto cells = unquoted_cells(lines[n], separator);
    for (std::size_t c = 0; c + 1 < cells.size(); ++c) {
      std::string_view cell = cells[c];
      if (cell.ends_with(':')) cell.remove_suffix(1);
      if (equal_ignoring_case(trim(cell), word)) return cells[c + 1];
    }
  }
  return "";
}

/// "Wrist X", "Wrist.x", "Wrist_x", "Wrist:X": the name if the ending is this axis.
std::optional<std::string> name_before_axis(const std::string& cell, char axis) {
  if (cell.size() < 3) return std::nullopt;
  const char last = static_cast<char>(cell.back() | 0x20);
  const char before = cell[cell.size() - 2];
  if (last != axis || (before != ' ' && before != '.' && before != '_' && before != ':'))
    return std::nullopt;
  return std::string(trim(std::string_view(cell).substr(0, cell.size() - 2)));
}

/// Columns NAME x, NAME y, NAME z after up to two columns of frames and times.
bool take_triples(const std::vector<std::string>& header, MarkerLayout& layout) {
  std::size_t c = 0;
  for (; c < header.size() && c < 3; ++c) {
    if (name_before_axis(header[c], 'x')) break;
    if (equal_ignoring_case(header[c], "frame") || equal_ignoring_case(header[c], "frame#"))
      layout.frame_column = c;
    if (equal_ignoring_case(header[c], "time")) layout.time_column = c;
  }
  layout.first_column = c;
  for (; c + 2 < header.size(); c += 3) {
    const auto name = name_before_axis(header[c], 'x');
    if (!name || name_before_axis(header[c + 1], 'y') != name ||
        name_before_axis(header[c + 2], 'z') != name)
      break;
    layout.names.push_back(*name);
  }
  return !layout.names.empty();
}

std::optional<MarkerLayout> vicon_layout(const Lines& lines) {
  MarkerLayout layout;
  std::size_t at = 0;
  while (at < lines.size() && trim(lines[at]).substr(0, 12) != "Trajectories") ++at;
  if (at + 5 >= lines.size()) return std::nullopt;
  const std::string_view title = trim(lines[at]).substr(12);
  if (title.find_first_not_of(",\t;") != std::string_view::npos) return std::nullopt;
  layout.separator = lines[at + 3].find('\t') != std::string_view::npos ? '\t' : ',';
  const auto rate = unquoted_cells(lines[at + 1], layout.separator);
  layout.rate_hz = rate.empty() ? 0.0 : parse_number(rate[0]).value_or(0.0);
  const auto names = unquoted_cells(lines[at + 2], layout.separator);
  const auto axes = unquoted_cells(lines[at + 3], layout.separator);
  const auto units = unquoted_cells(lines[at + 4], layout.separator);
  if (axes.empty() || !equal_ignoring_case(axes[0], "Frame")) return std::nullopt;
  layout.frame_column = 0;
  layout.first_column = 2;
  for (std::size_t c = 2; c + 2 < axes.size() && c < names.size(); c += 3) {
    if (!equal_ignoring_case(axes[c], "X") || names[c].empty()) break;
    layout.names.push_back(names[c]);
  }
  if (layout.names.empty()) return std::nullopt;
  layout.unit = units.size() > 2 ? units[2] : "";
  layout.first_row = at + 5;
  layout.end_row = layout.first_row;
  while (layout.end_row < lines.size() && !trim(lines[layout.end_row]).empty()) ++layout.end_row;
  return layout;
}

std::optional<MarkerLayout> qualisys_layout(const Lines& lines) {
  if (lines.empty() || !trim(lines[0]).starts_with("NO_OF_FRAMES")) return std::nullopt;
  if (text_behind(lines, 20, "DATA_INCLUDED", '\t') != "3D") return std::nullopt;
  MarkerLayout layout;
  layout.separator = '\t';
  layout.unit = "mm";
  layout.zero_is_missing = true;
  layout.rate_hz = number_behind(lines, 20, "FREQUENCY").value_or(0.0);
  std::size_t n = 0;
  for (; n < std::min<std::size_t>(lines.size(), 40); ++n) {
    auto cells = unquoted_cells(lines[n], '\t');
    if (cells.empty()) continue;
    if (cells[0] == "MARKER_NAMES") {
      while (!cells.empty() && cells.back().empty()) cells.pop_back();
      layout.names.assign(cells.begin() + 1, cells.end());
    } else if (equal_ignoring_case(cells[0], "Frame")) {
      layout.frame_column = 0;
      layout.first_column = 1;
      if (cells.size() > 1 && equal_ignoring_case(cells[1], "Time")) {
        layout.time_column = 1;
        layout.first_column = 2;
      }
      ++n;
      break;
    } else if (!layout.names.empty() && cells.size() > 1 &&
               (cells[0].empty() || parse_number(cells[0]))) {
      break;
    }
  }
  layout.first_row = n;
  layout.end_row = lines.size();
  if (layout.names.empty()) return std::nullopt;
  return layout;
}

std::optional<MarkerLayout> bts_layout(const Lines& lines) {
  if (lines.empty() || !trim(lines[0]).starts_with("BTS ASCII")) return std::nullopt;
  MarkerLayout layout;
  layout.separator = '\t';
  layout.unit = text_behind(lines, 20, "Measure unit", '\t');
  layout.rate_hz = number_behind(lines, 20, "Frequency").value_or(0.0);
  for (std::size_t n = 0; n < std::min<std::size_t>(lines.size(), 40); ++n) {
    const auto cells = unquoted_cells(lines[n], '\t');
    if (cells.empty() || !equal_ignoring_case(cells[0], "Frame")) continue;
    if (!take_triples(cells, layout)) return std::nullopt;
    layout.first_row = n + 1;
    layout.end_row = lines.size();
    return layout;
  }
  return std::nullopt;
}

std::optional<MarkerLayout> first_principles(const Lines& lines) {
  for (std::size_t n = 0; n < std::min<std::size_t>(lines.size(), 20); ++n) {
    for (const char separator : {',', '\t', ';'}) {
      MarkerLayout layout;
      layout.separator = separator;
      const auto cells = unquoted_cells(lines[n], separator);
      if (cells.size() < 4 || !equal_ignoring_case(cells[0], "Frame") ||
          !take_triples(cells, layout))
        continue;
      // Nothing else beside them: other tables with such columns are no markers.
      if (layout.first_column + 3 * layout.names.size() +
              static_cast<std::size_t>(std::count(cells.begin(), cells.end(), "")) <
          cells.size())
        return std::nullopt;
      layout.rate_hz = number_behind(lines, n, "frequency").value_or(0.0);
      layout.unit = text_behind(lines, n, "Units", separator);
      layout.first_row = n + 1;
      layout.end_row = lines.size();
      return layout;
    }
  }
  return std::nullopt;
}

/// Motive: type, name, number and quantity of each column in rows of their own above "Frame".
std::optional<MarkerLayout> optitrack(const Lines& lines) {
  if (lines.empty() || !trim(lines[0]).starts_with("Format Version")) return std::nullopt;
  MarkerLayout layout;
  std::vector<std::string> types, names, kinds;
  for (std::size_t n = 1; n < std::min<std::size_t>(lines.size(), 12); ++n) {
    auto cells = unquoted_cells(lines[n], ',');
    if (cells.size() < 5) continue;
    const auto has = [&](std::string_view word) {
      return std::find(cells.begin(), cells.end(), word) != cells.end();
    };
    if (cells[0] == "Frame") {
      layout.frame_column = 0;
      layout.time_column = 1;
      layout.first_row = n + 1;
      kinds.resize(cells.size());
      types.resize(cells.size());
      names.resize(cells.size());
      for (const char* type : {"Marker", "Rigid Body Marker"}) {
        for (std::size_t c = 2; c + 2 < cells.size(); ++c) {
          if (types[c] != type || kinds[c] != "Position" || cells[c] != "X") continue;
          layout.names.push_back(names[c]);
          layout.columns.push_back(c);
        }
        if (!layout.names.empty()) break;
      }
      break;
    }
    if (has("Position")) {
      kinds = std::move(cells);
    } else if (types.empty()) {
      types = std::move(cells);
    } else if (names.empty()) {
      names = std::move(cells);
    }
  }
  if (layout.names.empty()) return std::nullopt;
  layout.first_column = 2;
  layout.end_row = lines.size();
  layout.unit = text_behind(lines, 1, "Length Units", ',');
  for (const auto& [word, symbol] :
       {std::pair("meters", "m"), std::pair("centimeters", "cm"), std::pair("millimeters", "mm")}) {
    if (equal_ignoring_case(layout.unit, word)) layout.unit = symbol;
  }
  return layout;
}

std::optional<MarkerLayout> find_layout(const Lines& lines) {
  if (auto layout = qualisys_layout(lines)) return layout;
  if (auto layout = bts_layout(lines)) return layout;
  if (auto layout = vicon_layout(lines)) return layout;
  if (auto layout = optitrack(lines)) return layout;
  return first_principles(lines);
}

}  // namespace

bool is_marker_table(std::string_view text) { return find_layout(split_lines(text)).has_value(); }

MarkerFile parse_marker_table(std::string_view text, const std::filesystem::path& path) {
  const Lines lines = split_lines(text);
  const std::optional<MarkerLayout> found = find_layout(lines);
  if (!found) {
    throw ReadError(path, 0,
                    "this is no table of markers that is known (Vicon Trajectories, Qualisys 3D, "
                    "BTS Point 3D tracks, NDI, OptiTrack); export .c3d or .trc");
  }
  const MarkerLayout& layout = *found;
  MarkerFile file;
  file.unit = layout.unit;
  if (file.unit.empty()) {
    file.unit = "mm";
    file.repairs.push_back({0, "no unit is stated; mm is assumed: compare a known distance"});
  }
  const auto unit = parse_c3d_unit(file.unit);
  if (!unit || unit->unit != Unit::meter)
    throw ReadError(path, 0, fmt::format("the unit is '{}', expected mm, cm or m", file.unit));
  if (!layout.time_column && !(layout.rate_hz > 0.0 && layout.rate_hz < 1e6)) {
    throw ReadError(path, 0, "the frame rate is not stated; add it to the header");
  }
  const std::set<std::string> unique(layout.names.begin(), layout.names.end());
  if (unique.size() < layout.names.size())
    throw ReadError(path, layout.first_row, "a marker's name stands twice; rename one of them");

  const auto column_of = [&](std::size_t marker) {
    return layout.columns.empty() ? layout.first_column + 3 * marker : layout.columns[marker];
  };
  const std::size_t width = column_of(layout.names.size() - 1) + 3;
  const auto columns = static_cast<Eigen::Index>(3 * layout.names.size());
  const auto most =
      static_cast<Eigen::Index>(layout.end_row - std::min(layout.end_row, layout.first_row));
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd positions(most, columns);
  Eigen::VectorXd time(most);
  Eigen::Index row = 0, zeros = 0;
  for (std::size_t n = layout.first_row; n < layout.end_row; ++n) {
    // A row of nothing but separators is a frame in which nothing was seen.
    if (trim(lines[n]).empty() && lines[n].find(layout.separator) == std::string_view::npos)
      continue;
    auto cells = unquoted_cells(lines[n], layout.separator);
    // Gaps at the end of a row may be cut off with their separators, by a spreadsheet.
    if (cells.size() <= layout.first_column) {
      throw ReadError(path, n + 1, fmt::format("{} cells, expected {}", cells.size(), width));
    }
    if (cells.size() < width) {
      if (n + 1 == layout.end_row) {
        file.repairs.push_back(
            {n + 1,
             fmt::format("the last row has {} of {} cells and is left out", cells.size(), width)});
        break;
      }
      if (layout.columns.empty() && (cells.size() - layout.first_column) % 3 != 0)
        throw ReadError(path, n + 1, fmt::format("{} cells, expected {}", cells.size(), width));
      cells.resize(width);
    }
    const auto number = [&](std::size_t c) {
      if (cells[c].empty() || equal_ignoring_case(cells[c], "nan") || cells[c] == "-") return kGap;
      auto value = parse_number(cells[c]);
      if (!value && layout.separator != ',') value = parse_comma_number(cells[c]);
      if (!value)
        throw ReadError(path, n + 1, fmt::format("expected a number, found '{}'", cells[c]));
      return *value;
    };
    time[row] = layout.time_column    ? number(*layout.time_column)
                : layout.frame_column ? (number(*layout.frame_column) - 1.0) / layout.rate_hz
                                      : static_cast<double>(row) / layout.rate_hz;
    if (!std::isfinite(time[row]) || (row > 0 && time[row] <= time[row - 1]))
      throw ReadError(path, n + 1, "the frame number or time does not increase");
    for (Eigen::Index m = 0; m < columns / 3; ++m) {
      Eigen::RowVector3d p;
      for (Eigen::Index a = 0; a < 3; ++a)
        p[a] = number(column_of(static_cast<std::size_t>(m)) + static_cast<std::size_t>(a)) *
               unit->to_si;
      const bool zero = layout.zero_is_missing && p.isZero(0.0);
      if (zero) ++zeros;
      positions.block<1, 3>(row, 3 * m) =
          p.allFinite() && !zero ? p : Eigen::RowVector3d::Constant(kGap).eval();
    }
    ++row;
  }
  if (row == 0) throw ReadError(path, layout.first_row + 1, "there are no rows of numbers");
  if (zeros > 0)
    file.repairs.push_back({0, fmt::format("{} positions are 0 0 0, which is a gap here", zeros)});
  file.markers.names = layout.names;
  file.markers.time_s = time.head(row);
  file.markers.positions_m = positions.topRows(row);
  return file;
}

}  // namespace myoid::recording
