#include "myoid/recording/trc_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/missing_value.h"
#include "myoid/recording/makers/marker_layouts.h"
#include "myoid/recording/tables/blank_columns.h"
#include "myoid/recording/tables/table_clock.h"
#include "myoid/recording/tables/table_layout.h"
#include "myoid/recording/tables/text_table.h"

namespace myoid::recording {
namespace {

/// Pairs the keys of one header line with the values of the next. Real files have two tabs between
/// values, so words are paired if their counts match; otherwise cells are.
std::map<std::string, std::string> read_fields(std::string_view keys, std::string_view values, char separator) {
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

/// Counts the markers in the columns behind Frame# and Time: by the line X1 Y1 Z1 ..., otherwise by
/// the filled cells of the first row.
std::size_t markers_in_columns(const std::vector<std::string_view>& lines, char separator) {
  const auto axes = split_words(lines[4]);
  if (!axes.empty() && axes.front().starts_with('X') && axes.size() % 3 == 0) return axes.size() / 3;
  for (std::size_t n = 4; n < lines.size(); ++n) {
    auto cells = split(lines[n], separator);
    while (!cells.empty() && trim(cells.back()).empty()) cells.pop_back();
    if (cells.size() >= 2 && parse_number(cells[0])) return cells.size() / 3;  // (cells - 2) / 3, rounded up
  }
  return 0;
}

/// Returns the names of a label line in which each stands over the first of its marker's three columns and some are
/// missing: an empty name for every marker without one. Empty if the names stand elsewhere.
std::vector<std::string> names_over_columns(const std::vector<std::string_view>& cells, std::size_t count) {
  std::vector<std::string> names(count);
  for (std::size_t c = 2; c < cells.size(); ++c) {
    if (trim(cells[c]).empty()) continue;
    if ((c - 2) % 3 != 0 || (c - 2) / 3 >= count) return {};
    names[(c - 2) / 3] = trim(cells[c]);
  }
  return names;
}

/// Returns the label line without Frame# and Time. Throws ReadError if its second word is no time.
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
        throw ReadError(path, number, fmt::format("expected the second column to be 'Time', found '{}'", name));
      }
      if (word == 2 && name != "Time") repairs.push_back({number, fmt::format("column '{}' read as 'Time'", name)});
      continue;
    }
    names.emplace_back(name);
  }
  return names;
}

/// Returns the markers of labels that name every axis, "Wrist_x", "Wrist_y", "Wrist_z"; empty for other labels.
std::vector<std::string> markers_of_axes(const std::vector<std::string>& labels) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < labels.size(); c += 3) {
    if (!is_axis_triple(labels, c)) return {};
    names.push_back(*name_before_axis(labels[c], 'x'));
  }
  return names;
}

/// Splits labels at two blanks or more.
std::vector<std::string> labels_between_blanks(const std::vector<std::string>& labels) {
  std::vector<std::string> apart;
  for (const std::string& label : labels)
    for (const std::string_view word : wide_cells(label)) apart.emplace_back(word);
  return apart;
}

/// Returns one marker name for each three columns: every word of the label line, wherever the tabs
/// are, and made-up names for markers that have none.
std::vector<std::string> read_names(const std::vector<std::string_view>& lines,
                                    char separator,
                                    const std::filesystem::path& path,
                                    std::vector<Repair>& repairs) {
  constexpr std::size_t kNumber = 4;
  auto names = label_words(lines[kNumber - 1], separator, path, kNumber, repairs);
  const std::size_t count = markers_in_columns(lines, separator);
  if (names.size() == 3 * count) {
    if (auto markers = markers_of_axes(names); !markers.empty()) {
      repairs.push_back({kNumber, fmt::format("three labels for each marker: '{}', '{}', '{}' are '{}'", names[0],
                                              names[1], names[2], markers[0])});
      names = std::move(markers);
    }
  }
  if (names.size() < count) {
    if (auto apart = labels_between_blanks(names); apart.size() == count) {
      repairs.push_back({kNumber, "blanks stand between labels in place of tabs"});
      names = std::move(apart);
    }
  }
  if (names.size() < count) {
    auto placed = names_over_columns(split(lines[kNumber - 1], separator), count);
    if (!placed.empty()) names = std::move(placed);
  }
  std::size_t made_up = 0;
  for (std::size_t m = 0; m < names.size(); ++m) {
    if (!names[m].empty()) continue;
    names[m] = fmt::format("marker_{}", m + 1);
    ++made_up;
  }
  names = unique_names(names, "marker", kNumber, repairs);
  if (made_up > 0)
    repairs.push_back(
        {kNumber,
         fmt::format(
             "{} of {} markers have no name; called 'marker_N' by their place, marker 1 in the columns behind Time",
             made_up, names.size())});
  return names;
}

/// The five lines above the frames.
struct Header {
  char separator = '\t';
  std::map<std::string, std::string> fields;
  ScaledUnit unit;  ///< Unit of the coordinates.
  std::vector<std::string> names;
  std::size_t first_frame = 5;  ///< Index of the first line of numbers.
  std::size_t shift = 0;        ///< Empty cells in front of every row.
  std::vector<Repair> repairs;

  [[nodiscard]] std::string field(const std::string& key) const {
    const auto it = fields.find(key);
    return it == fields.end() ? std::string() : it->second;
  }
};

Header read_header(const std::vector<std::string_view>& lines, const std::filesystem::path& path) {
  if (lines.empty() || !trim(lines[0]).starts_with("PathFileType")) {
    throw ReadError(path, 1,
                    fmt::format("expected 'PathFileType' as the first word, found '{}'; this is not a .trc file",
                                lines.empty() ? "" : trim(lines[0]).substr(0, 40)));
  }
  if (lines.size() < 5) throw ReadError(path, lines.size(), "the file is cut off: its header has five lines");
  Header header;
  if (lines[1].find('\t') == std::string_view::npos && lines[1].find(',') != std::string_view::npos) {
    header.separator = ',';
    header.repairs.push_back({2, "separated by commas instead of tabs"});
  }
  header.fields = read_fields(lines[1], lines[2], header.separator);
  const std::string word = header.field("Units");
  const auto unit = parse_unit(word) ? parse_unit(word) : parse_unit(small_letters(word));
  if (!unit || unit->unit != Unit::meter) {
    throw ReadError(path, 3,
                    fmt::format("Units: found '{}', expected mm or m; correct the header", header.field("Units")));
  }
  header.unit = *unit;
  header.names = read_names(lines, header.separator, path, header.repairs);
  if (header.names.empty()) throw ReadError(path, 4, "there are no markers after Frame# and Time");
  compare_count(parse_number(header.field("NumMarkers")), header.names.size(), "markers", header.repairs, 3);
  if (trim(lines[4]).starts_with("X0")) header.repairs.push_back({5, "coordinates numbered from 0"});
  // Some exporters leave out the line X1 Y1 Z1 ...: then the fifth line is a frame.
  const auto fifth = split(lines[4], header.separator);
  const std::size_t frame = !fifth.empty() && trim(fifth[0]).empty() ? 1 : 0;
  if (fifth.size() > 2 + frame && parse_number(fifth[frame]) && parse_number(fifth[frame + 1])) {
    header.first_frame = 4;
    header.repairs.push_back({5, "the line X1 Y1 Z1 ... is missing"});
  }
  while (header.first_frame < lines.size() &&
         lines[header.first_frame].find_first_not_of(" \t,\r") == std::string_view::npos)
    ++header.first_frame;
  return header;
}

/// Returns true if the rows have an empty cell in front of the frame's number: their first cell is always empty, their
/// second counts the frames, and their third is a time in the stated rate. Throws ReadError where the first cell is
/// always empty and the second counts like a frame, but the third is no such time.
bool rows_are_shifted(const TableText& text, const Header& header, const std::filesystem::path& path) {
  std::vector<double> second, third;
  for (std::size_t n = header.first_frame; n < text.lines.size(); ++n) {
    if (text.lines[n].find_first_not_of(" \t,\r") == std::string_view::npos) continue;
    const auto cells = split(text.lines[n], header.separator);
    if (cells.size() < 3 || !trim(cells[0]).empty()) return false;
    const auto number = [&](std::string_view cell) {
      const auto value = parse_number(cell);
      return (value || header.separator == ',' ? value : parse_comma_number(trim(cell))).value_or(kNan);
    };
    second.push_back(number(cells[1]));
    third.push_back(number(cells[2]));
  }
  if (second.size() < 2) return false;
  bool counts = true;
  for (std::size_t i = 0; i < second.size(); ++i)
    counts = counts && second[i] == std::floor(second[i]) && (i == 0 || second[i] == second[i - 1] + 1.0);
  if (!counts) return false;  // the frames have no numbers
  const double said = parse_number(header.field("DataRate")).value_or(0.0);
  const double rate = static_cast<double>(third.size() - 1) / (third.back() - third.front());
  if (said > 0.0 && std::abs(rate - said) <= 0.05 * said) return true;
  if (said > 0.0 && std::abs(said - 1.0) <= 0.05) return false;
  throw ReadError(
      path, header.first_frame + 1,
      "the first cell of every row is empty and the second counts the frames, but the third is no time at {} "
      "Hz; export the file again",
      said);
}

/// Reads the frames and keeps the first line of each kind of repair.
class TrcFrames {
 public:
  TrcFrames(const Header& header, const std::filesystem::path& path)
      : header_(header),
        path_(path),
        width_(3 * header.names.size()),
        frames_said_(parse_number(header.field("NumFrames"))) {}

  void read(const TableText& text) {
    const auto& lines = text.lines;
    values_.resize(static_cast<Eigen::Index>(lines.size()), static_cast<Eigen::Index>(width_));
    for (std::size_t n = header_.first_frame; n < lines.size(); ++n) {
      if (lines[n].find_first_not_of(" \t,\r") == std::string_view::npos) continue;
      auto cells = split(lines[n], header_.separator);
      cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(std::min(header_.shift, cells.size())));
      const bool last = n + 1 == lines.size();
      if (last && !text.ends_with_line && !keeps_last(text, cells.size())) break;
      const double time = time_of(cells, lines[n], n + 1);
      require_order(time, n + 1);
      if (cells.size() < width_ + 2) {
        if (last) {
          leave_out_last(cells.size(), n + 1);
          break;
        }
        mark(short_line_, n + 1);
      }
      read_coordinates(cells, n + 1);
      mark_missing(n + 1);
      time_.push_back(time);
    }
    if (time_.empty())
      throw ReadError(path_, lines.size(), "there are no frames after the header; export the file again");
    if (repeated_line_ > 0) settle_repeats();
    state_what_was_mended();
  }

  [[nodiscard]] const std::vector<Repair>& repairs() const { return repairs_; }

  [[nodiscard]] MarkerSeries markers() const {
    const auto frames = static_cast<Eigen::Index>(time_.size());
    MarkerSeries markers;
    markers.names = header_.names;
    markers.time_s = Eigen::Map<const Eigen::VectorXd>(time_.data(), frames);
    markers.positions_m = values_.topRows(frames);
    return markers;
  }

 private:
  std::optional<double> number_of(std::string_view cell, std::size_t line) {
    auto number = parse_number(cell);
    if (!number && header_.separator != ',') {
      number = parse_comma_number(cell);
      if (number) mark(comma_line_, line);
    }
    return number;
  }

  bool keeps_last(const TableText& text, std::size_t cells) {
    const bool counted = !frames_said_ || *frames_said_ == static_cast<double>(time_.size() + 1);
    const LastRow last = last_row_without_end(text, counted && cells >= width_ + 2, time_.empty());
    repairs_.push_back(last.note);
    return last.kept;
  }

  /// Leaves out a last row that ends early: the file was cut off, perhaps within a number.
  void leave_out_last(std::size_t cells, std::size_t line) {
    repairs_.push_back({line, fmt::format("the last row has {} of {} cells and is left out", cells, width_ + 2)});
  }

  double time_of(const std::vector<std::string_view>& cells, std::string_view row, std::size_t line) {
    if (cells.size() < 2)
      throw ReadError(path_, line,
                      fmt::format("expected frame, time and {} coordinates, found '{}'", width_, trim(row)));
    const auto time = number_of(cells[1], line);
    if (!time || !std::isfinite(*time))
      throw ReadError(path_, line, fmt::format("expected the time as a number, found '{}'", trim(cells[1])));
    return *time;
  }

  /// Marks a time that equals that of the row before. Throws ReadError for an earlier one.
  void require_order(double time, std::size_t line) {
    if (time_.empty() || time > time_.back()) return;
    if (time < time_.back())
      throw ReadError(
          path_, line,
          fmt::format("time goes backwards: {} s after {} s; sort the rows or split the file", time, time_.back()));
    mark(repeated_line_, line);
  }

  /// Gives the frames the times of the stated rate where the file's times are these, rounded: 240 frames a second with
  /// two decimals. Leaves out the later rows of a time otherwise: a row is doubled where a decimal tells frames apart.
  void settle_repeats() {
    const double rate = parse_number(header_.field("DataRate")).value_or(0.0);
    repeated_ = recording::settle_repeats(time_, values_, rate);
    if (repeated_ > 0) return;
    repairs_.push_back(
        {repeated_line_, fmt::format("rounded times stand twice; the frames have those of {} Hz", rate)});
    repeated_line_ = 0;
  }

  /// Fills the next row; an empty or missing cell is a gap.
  void read_coordinates(const std::vector<std::string_view>& cells, std::size_t line) {
    const auto row = static_cast<Eigen::Index>(time_.size());
    for (std::size_t c = 0; c < width_; ++c) {
      const std::string_view cell = c + 2 < cells.size() ? trim(cells[c + 2]) : std::string_view();
      double value = kNan;
      if (!cell.empty()) {
        const auto number = number_of(cell, line);
        if (!number)
          throw ReadError(path_, line,
                          fmt::format("expected a number for {} of marker '{}', found '{}'", "XYZ"[c % 3],
                                      header_.names[c / 3], cell));
        value = *number * header_.unit.to_si;
      }
      values_(row, static_cast<Eigen::Index>(c)) = value;
    }
    for (std::size_t c = width_ + 2; c < cells.size() && surplus_line_ == 0; ++c) {
      if (!trim(cells[c]).empty()) surplus_line_ = line;
    }
  }

  /// Makes a gap of a marker at 0 0 0, beyond kFarthest_m, without one of its coordinates, or with a number that stands
  /// for a missing one three times.
  void mark_missing(std::size_t line) {
    const auto row = static_cast<Eigen::Index>(time_.size());
    for (std::size_t m = 0; m < header_.names.size(); ++m) {
      auto position = values_.block<1, 3>(row, static_cast<Eigen::Index>(3 * m));
      const bool zero = (position.array() == 0.0).all();
      const bool far = (position.array().abs() > kFarthest_m).any();
      const bool none =
          (position.array() == position[0]).all() && may_stand_for_missing(position[0] / header_.unit.to_si);
      if (zero) mark(zero_line_, line);
      if (none) mark(none_line_, line);
      if (far) mark(far_line_, line);
      if (position.hasNaN() && !position.array().isNaN().all()) mark(partial_line_, line);
      if (zero || far || none || !position.allFinite()) position.setConstant(kNan);
    }
  }

  void state_what_was_mended() {
    note(zero_line_, "a marker at exactly 0 0 0 is taken as missing");
    note(none_line_, "a marker has nines for all three coordinates (-9999 -9999 -9999); taken as missing");
    note(far_line_, "a marker is more than 1000 km away; taken as missing");
    note(comma_line_, "comma decimals read as decimal points");
    note(short_line_, "a row ends early; the markers behind its end are taken as missing");
    note(partial_line_, "a marker has only some of its coordinates; taken as missing");
    note(surplus_line_, "a row has more numbers than there are markers; the surplus is ignored");
    note(repeated_line_, "a time stands twice; the first row is kept");
    compare_count(frames_said_, time_.size() + repeated_, "frames", repairs_, 3);
    const std::size_t frames = time_.size();
    const double rate = frames < 2 ? 0.0 : static_cast<double>(frames - 1) / (time_.back() - time_[0]);
    const double said = parse_number(header_.field("DataRate")).value_or(0.0);
    constexpr double kOtherQuantity = 20.0;
    if (rate > 0.0 && said > 0.0 && (rate > kOtherQuantity * said || said > kOtherQuantity * rate))
      throw ReadError(
          path_, header_.first_frame + 1,
          "the header says {} Hz, the column of the time {:.6g} Hz: that column is no time in seconds, or the "
          "columns are shifted; correct the file",
          said, rate);
    if (rate > 0.0 && said > 0.0 && std::abs(rate - said) > 0.05 * said)
      repairs_.push_back(other_rate(3, said, rate, static_cast<double>(frames - 1)));
  }

  static void mark(std::size_t& first, std::size_t line) {
    if (first == 0) first = line;
  }
  void note(std::size_t line, const char* message) {
    if (line > 0) repairs_.push_back({line, message});
  }

  const Header& header_;
  const std::filesystem::path& path_;
  std::size_t width_;
  std::optional<double> frames_said_;
  std::vector<double> time_;
  Eigen::MatrixXd values_;
  std::vector<Repair> repairs_;
  std::size_t zero_line_ = 0, none_line_ = 0, far_line_ = 0, repeated_line_ = 0, short_line_ = 0, repeated_ = 0;
  std::size_t surplus_line_ = 0, comma_line_ = 0, partial_line_ = 0;
};

}  // namespace

MarkerFile parse_trc(std::string_view text, const std::filesystem::path& path) {
  const TableText table(text);
  Header header = read_header(table.lines, path);
  if (rows_are_shifted(table, header, path)) {
    header.shift = 1;
    header.repairs.push_back({header.first_frame + 1, "an empty cell stands in front of every row; passed over"});
  }
  TrcFrames frames(header, path);
  frames.read(table);
  MarkerFile file;
  file.markers = frames.markers();
  file.unit = header.field("Units");
  for (const std::vector<Repair>* repairs : {&std::as_const(header.repairs), &frames.repairs()})
    file.repairs.insert(file.repairs.end(), repairs->begin(), repairs->end());
  return file;
}

MarkerFile read_trc(const std::filesystem::path& path) { return parse_trc(read_text_file(path), path); }

}  // namespace myoid::recording
