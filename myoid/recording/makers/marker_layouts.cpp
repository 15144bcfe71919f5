#include "myoid/recording/makers/marker_layouts.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/unique_names.h"
#include "myoid/recording/makers/nexus_section.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;
using Cells = std::vector<std::string>;

constexpr std::size_t kHeaderLines = 40;  // more lines than any header has

void add_marker(const std::string& name, MarkerLayout& layout) {
  layout.names.push_back(name);
  for (const char* axis : {"X", "Y", "Z"})
    layout.table.columns.push_back({Kind::channel, name.empty() ? axis : name + " " + axis});
}

/// Takes columns NAME x, NAME y, NAME z that follow up to two columns of frames and times; false if there are none.
bool take_triples(const Cells& header, MarkerLayout& layout) {
  std::size_t c = 0;
  for (; c < header.size() && c < 3 && !is_axis_triple(header, c); ++c) {
    const std::string name = lower(header[c]);
    const Kind kind = name == "frame" || name == "frame#"    ? Kind::frame
                      : name == "time" || name == "time (s)" ? Kind::time
                                                             : Kind::left_out;
    layout.table.columns.push_back({kind, header[c]});
  }
  for (; is_axis_triple(header, c); c += 3) add_marker(*name_before_axis(header[c], 'x'), layout);
  for (; c < header.size(); ++c) layout.table.columns.push_back({Kind::left_out, header[c]});
  return !layout.names.empty();
}

/// Throws ReadError naming the first column behind frame and time that belongs to no marker.
void require_triples(const MarkerLayout& layout, const std::filesystem::path& path) {
  const auto& columns = layout.table.columns;
  for (std::size_t c = 2; c < columns.size(); ++c) {
    if (columns[c].kind == Kind::left_out)
      throw ReadError(path, layout.table.names_line + 1,
                      fmt::format("column {} ('{}') belongs to no marker: expected NAME X, NAME Y, NAME Z for each",
                                  c + 1, columns[c].name));
  }
}

std::optional<MarkerLayout> nexus_trajectories(const TableText& text, const std::filesystem::path& path) {
  const auto section = nexus_section(text, "Trajectories", path);
  if (!section) return std::nullopt;
  MarkerLayout layout;
  layout.table = section->layout;
  const std::size_t line = layout.table.names_line + 1;
  if (layout.table.columns.size() < 2 || layout.table.columns[1].kind != Kind::sub_frame)
    throw ReadError(path, line, "expected 'Sub Frame' in column 2 of the row that begins with Frame");
  layout.table.columns.resize(2);
  if (section->groups.empty())
    throw ReadError(path, line, "the row of marker names above 'Frame, Sub Frame' is missing");
  std::set<std::size_t> places;  // of X of a marker
  for (std::size_t c = 2; c < section->labels.size();) {
    const auto label = [&](std::size_t a) { return c + a < section->labels.size() ? section->labels[c + a] : ""; };
    if (label(0).ends_with('\'')) {  // speeds X' and accelerations X''
      layout.table.columns.push_back({Kind::left_out, label(0)});
      ++c;
      continue;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      if (lower(label(a)) != std::string(1, "xyz"[a]))
        throw ReadError(path, line,
                        fmt::format("expected {} in column {}, found '{}': each marker has X, Y and Z", "XYZ"[a],
                                    c + a + 1, label(a)));
    }
    places.insert(c);
    add_marker(c < section->groups.size() ? section->groups[c] : "", layout);
    c += 3;
  }
  for (std::size_t c = 0; c < section->groups.size(); ++c) {
    if (!places.contains(c) && !section->groups[c].empty())
      throw ReadError(
          path, line - 1,
          fmt::format("the name '{}' stands in column {}, where no X is: a cell of this row is lost or too many",
                      section->groups[c], c + 1));
  }
  if (layout.names.empty()) return std::nullopt;
  leave_out_subject(layout.names, line - 1, layout.table.repairs);
  for (std::size_t c = 2; c < std::min(section->units.size(), layout.table.columns.size()); ++c) {
    const std::string& unit = section->units[c];
    if (layout.table.columns[c].kind != Kind::channel || unit.empty()) continue;
    if (layout.unit.empty()) layout.unit = unit;
    if (unit != layout.unit)
      throw ReadError(path, line + 1,
                      fmt::format("the units '{}' and '{}' stand in one table of markers", layout.unit, unit));
  }
  const auto others = layout.table.count(Kind::left_out);
  if (others > 0)
    layout.table.repairs.push_back({line, fmt::format("{} columns of speeds and accelerations are left out", others)});
  layout.table.short_row = ShortRow::gaps;
  return layout;
}

/// Reads the row above the frames: Frame, Time, and in some files the markers' names.
void read_frame_row(
    const Cells& cells, std::size_t line, const std::filesystem::path& path, TableLayout& table, Cells& names) {
  table.columns.push_back({Kind::frame, "Frame"});
  if (cells.size() > 1 && equal_ignoring_case(cells[1], "Time")) table.columns.push_back({Kind::time, "Time"});
  if (cells.size() <= table.columns.size()) return;
  MarkerLayout named;
  if (!take_triples(cells, named)) throw ReadError(path, line, "expected Frame, Time, then NAME X, NAME Y, NAME Z");
  require_triples(named, path);
  while (!names.empty() && names.back().empty() && names.size() > named.names.size()) names.pop_back();
  if (!names.empty() && names != named.names)
    throw ReadError(path, line, "this row names other markers than MARKER_NAMES: which is it?");
  names = named.names;
}

std::optional<MarkerLayout> qualisys_markers(const TableText& text, const std::filesystem::path& path) {
  const std::size_t head = std::min(text.lines.size(), kHeaderLines);
  if (text.lines.empty() || !trim(text.lines[0]).starts_with("NO_OF_")) return std::nullopt;
  const std::string included = stated_text(text, head, '\t', "DATA_INCLUDED");
  const bool has_names = std::any_of(text.lines.begin(), text.lines.begin() + static_cast<std::ptrdiff_t>(head),
                                     [](std::string_view line) { return line.starts_with("MARKER_NAMES"); });
  if (included != "3D" && !(included.empty() && has_names)) return std::nullopt;
  MarkerLayout layout;
  TableLayout& table = layout.table;
  table.separator = '\t';
  layout.unit = "mm";
  layout.zero_is_missing = true;
  Cells names;
  std::size_t n = 0;
  for (; n < head; ++n) {
    Cells cells = filled_cells(text.lines[n], '\t');
    if (cells.empty() ? !names.empty()
                      : parse_number(cells[0]) || parse_comma_number(cells[0]) || (cells[0].empty() && !names.empty()))
      break;  // the first frame: its row may have empty cells where a marker was not seen
    if (cells.empty()) continue;
    if (cells[0] == "MARKER_NAMES") {
      table.names_line = n;
      names = cells_of(text.lines[n], '\t');
      names.erase(names.begin());
    } else if (equal_ignoring_case(cells[0], "Frame")) {
      read_frame_row(cells, n + 1, path, table, names);
      ++n;
      break;
    }
  }
  table.first_row = n;
  table.end_row = text.lines.size();
  table.read_header(text, n, {{"frequency"}, {"no_of_frames"}, {"no_of_markers"}});
  // A tab behind the last name is no marker, unless the header counts one more.
  while (!names.empty() && names.back().empty() &&
         !(table.channels_said && static_cast<double>(names.size()) <= *table.channels_said))
    names.pop_back();
  if (names.empty()) throw ReadError(path, 1, "there is no line MARKER_NAMES, so no marker has a name");
  for (const std::string& name : names) add_marker(name, layout);
  table.short_row = ShortRow::gaps;
  return layout;
}

bool is_of_bts(const TableText& text) { return !text.lines.empty() && trim(text.lines[0]).starts_with("BTS ASCII"); }

std::optional<MarkerLayout> bts_points(const TableText& text, const std::filesystem::path& path) {
  if (!is_of_bts(text)) return std::nullopt;
  const std::size_t head = std::min(text.lines.size(), kHeaderLines);
  const bool points = lower(stated_text(text, head, '\t', "type")).find("point") != std::string::npos;
  for (std::size_t n = 0; n < head; ++n) {
    const Cells cells = filled_cells(text.lines[n], '\t');
    if (cells.empty() || !equal_ignoring_case(cells[0], "Frame")) continue;
    MarkerLayout layout;
    if (!take_triples(cells, layout)) return std::nullopt;
    layout.table.set_rows_below(text, n, '\t');
    require_triples(layout, path);
    layout.unit = stated_text(text, n, '\t', "Measure unit");
    const auto unit = parse_file_unit(layout.unit);
    if (!points && unit && unit->unit != Unit::meter) return std::nullopt;  // tracks of forces
    layout.table.read_header(text, n, {{"frequency"}, {"frames"}, {"tracks"}});
    layout.table.short_row = ShortRow::gaps;
    return layout;
  }
  if (points) throw ReadError(path, 1, "there is no row of names that begins with 'Frame'");
  return std::nullopt;
}

std::optional<MarkerLayout> first_principles(const TableText& text, const std::filesystem::path& /*path*/) {
  constexpr std::size_t kLines = 20;
  if (is_of_bts(text)) return std::nullopt;
  for (std::size_t n = 0; n < std::min(text.lines.size(), kLines); ++n) {
    for (const char separator : {',', '\t', ';'}) {
      MarkerLayout layout;
      const Cells cells = filled_cells(text.lines[n], separator);
      if (cells.size() < 4 || !equal_ignoring_case(cells[0], "Frame") || !take_triples(cells, layout)) continue;
      // A table with further columns beside such triples is no table of markers.
      const bool others = std::any_of(layout.table.columns.begin() + 1, layout.table.columns.end(),
                                      [](const TableColumn& c) { return c.kind == Kind::left_out; });
      if (others) return std::nullopt;
      layout.table.set_rows_below(text, n, separator);
      layout.table.read_header(
          text, n, {{"collection frequency", "frequency", "frame rate"}, {"number of frames"}, {"number of markers"}});
      layout.unit = stated_text(text, n, separator, "Units");
      layout.table.short_row = ShortRow::gaps;
      return layout;
    }
  }
  return std::nullopt;
}

/// The rows above "Frame" in a file of Motive: type, name, number and quantity of each column.
struct MotiveHeader {
  Cells types, names, kinds, axes;
  std::size_t frame_line = 0;
};

bool all_of_words(const Cells& cells, std::initializer_list<std::string_view> words) {
  bool any = false;
  for (const std::string& cell : cells) {
    if (cell.empty()) continue;
    if (std::ranges::find(words, cell) == words.end()) return false;
    any = true;
  }
  return any;
}

/// Returns true for a row of column identifiers: decimal numbers or 32 hexadecimal digits.
bool are_numbers_of_columns(const Cells& cells) {
  constexpr std::size_t kDigits = 32;
  return std::ranges::all_of(cells, [](const std::string& cell) {
    return cell.find_first_not_of("0123456789") == std::string::npos || cell == "ID" ||
           (cell.size() >= kDigits && cell.find_first_not_of("0123456789ABCDEFabcdef-") == std::string::npos);
  });
}

std::optional<MotiveHeader> motive_header(const TableText& text, const std::filesystem::path& path) {
  constexpr std::size_t kLines = 12;
  MotiveHeader header;
  std::vector<std::pair<std::size_t, Cells>> between;
  for (std::size_t n = 1; n < std::min(text.lines.size(), kLines); ++n) {
    Cells cells = filled_cells(text.lines[n], ',');
    if (cells.empty()) continue;
    if (cells[0] == "Frame") {
      header.axes = std::move(cells);
      header.frame_line = n;
      break;
    }
    if (all_of_words(cells, {"Type", "Marker", "Rigid Body", "Rigid Body Marker", "Bone", "Bone Marker", "Skeleton",
                             "Force Plate", "Device"})) {
      header.types = std::move(cells);
    } else if (all_of_words(cells, {"Position", "Rotation", "Mean Marker Error", "Marker Quality", "Marker Error",
                                    "Error Per Marker"})) {
      header.kinds = std::move(cells);
    } else if (!header.types.empty() && header.kinds.empty()) {
      between.emplace_back(n, std::move(cells));
    }
  }
  if (header.axes.empty()) throw ReadError(path, 1, "there is no row that begins with 'Frame'; export the take again");
  if (header.types.empty() || header.kinds.empty() || between.empty() ||
      (between.size() == 1 && are_numbers_of_columns(between[0].second)))
    throw ReadError(
        path, header.frame_line + 1,
        "expected rows of types (Marker, Rigid Body), names and quantities (Position) above this row; one is missing");
  header.names = std::move(between[0].second);
  return header;
}

/// Finds Motive's layout: takes the markers as measured, or, without these, the markers of its rigid bodies.
std::optional<MarkerLayout> motive_markers(const TableText& text, const std::filesystem::path& path) {
  if (text.lines.empty() || !trim(text.lines[0]).starts_with("Format Version")) return std::nullopt;
  const auto header = motive_header(text, path);
  const auto cell = [](const Cells& cells, std::size_t c) { return c < cells.size() ? cells[c] : std::string(); };
  const std::size_t width =
      std::max({header->types.size(), header->kinds.size(), header->axes.size(), header->names.size()});
  MarkerLayout layout;
  layout.table.columns = {{Kind::frame, "Frame"}, {Kind::time, "Time"}};
  std::size_t others = 0;
  const bool seen = std::ranges::find(header->types, "Marker") != header->types.end();
  for (std::size_t c = 2; c < width;) {
    const bool marker =
        cell(header->types, c) == (seen ? "Marker" : "Rigid Body Marker") && cell(header->kinds, c) == "Position";
    if (!marker) {
      layout.table.columns.push_back({Kind::left_out, cell(header->names, c)});
      ++others;
      ++c;
      continue;
    }
    const std::string name = cell(header->names, c);
    for (std::size_t a = 0; a < 3; ++a) {
      if (cell(header->axes, c + a) != std::string(1, "XYZ"[a]) || cell(header->names, c + a) != name ||
          cell(header->types, c + a) != cell(header->types, c))
        throw ReadError(
            path, header->frame_line + 1,
            fmt::format("columns {} to {} are not X, Y and Z of one marker: the rows of the header do not go together",
                        c + 1, c + 3));
    }
    add_marker(name, layout);
    c += 3;
  }
  if (layout.names.empty()) throw ReadError(path, 0, "no column is the position of a marker");
  if (others > 0)
    layout.table.repairs.push_back(
        {header->frame_line + 1, fmt::format("{} columns of rigid bodies and other quantities are left out", others)});
  // A marker that Motive lost and found again is a new column of its old name.
  layout.names = unique_names(layout.names, "marker", header->frame_line + 1, layout.table.repairs);
  layout.table.set_rows_below(text, header->frame_line, ',');
  layout.table.first_frame = 0.0;
  layout.table.read_header(text, 1, {{"export frame rate", "capture frame rate"}, {"total exported frames"}, {}});
  layout.unit = stated_text(text, 1, ',', "Length Units");
  for (const auto& [word, symbol] :
       {std::pair("meters", "m"), std::pair("centimeters", "cm"), std::pair("millimeters", "mm")}) {
    if (equal_ignoring_case(layout.unit, word)) layout.unit = symbol;
  }
  layout.table.short_row = ShortRow::gaps;
  return layout;
}

}  // namespace

std::optional<std::string> name_before_axis(const std::string& cell, char axis) {
  if (cell.empty() || static_cast<char>(cell.back() | 0x20) != axis) return std::nullopt;
  if (cell.size() == 1) return "";
  const char before = cell[cell.size() - 2];
  if (before != ' ' && before != '.' && before != '_' && before != ':') return std::nullopt;
  return std::string(trim(std::string_view(cell).substr(0, cell.size() - 2)));
}

bool is_axis_triple(const Cells& header, std::size_t c) {
  if (c + 2 >= header.size()) return false;
  const auto name = name_before_axis(header[c], 'x');
  return name && name_before_axis(header[c + 1], 'y') == name && name_before_axis(header[c + 2], 'z') == name;
}

std::optional<MarkerLayout> marker_layout(const TableText& text, const std::filesystem::path& path) {
  for (const auto& known : {qualisys_markers, bts_points, nexus_trajectories, motive_markers, first_principles}) {
    if (auto layout = known(text, path)) return layout;
  }
  return std::nullopt;
}

}  // namespace myoid::recording
