#include "myoid/recording/makers/emg_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/written_time.h"
#include "myoid/recording/makers/channel_layouts.h"
#include "myoid/recording/makers/discover_events.h"
#include "myoid/recording/tables/blank_columns.h"
#include "myoid/recording/tables/channel_labels.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;
using Cells = std::vector<std::string>;

/// Reads a cell; one with a comma between commas stood in quotes.
std::optional<double> cell_number(const std::string& cell) {
  if (const auto value = parse_number(cell)) return value;
  if (const auto time = written_time_s(cell)) return time;
  return parse_comma_number(cell);
}

/// Returns true for a row that holds at least one number and otherwise only numbers and gaps.
bool is_numbers(const Cells& cells) {
  std::size_t numbers = 0;
  for (const std::string& cell : cells) {
    if (cell.empty() || is_gap_word(cell)) continue;
    if (!cell_number(cell)) return false;
    ++numbers;
  }
  return numbers > 0;
}

std::size_t filled(const Cells& cells) {
  std::size_t n = cells.size();
  while (n > 0 && cells[n - 1].empty()) --n;
  return n;
}

/// Reads name and unit from "Label: EMG 1 Sampling frequency: 1925.926 Unit: V Domain: Time".
std::optional<TableColumn> label_line(std::string_view line) {
  const std::string text = lower(line);
  const std::size_t begin = text.find("label:");
  const std::size_t unit = text.find("unit:");
  if (begin == std::string::npos || unit == std::string::npos) return std::nullopt;
  const std::size_t end = std::min(text.find("sampling", begin), unit);
  if (end < begin + 6) return std::nullopt;
  TableColumn column;
  column.name = to_utf8(trim(line.substr(begin + 6, end - begin - 6)));
  const auto words = split_words(line.substr(unit + 5));
  if (!words.empty()) column.unit = parse_file_unit(words[0]);
  return column;
}

/// Returns true where all lines state one rate.
bool are_one(const std::vector<StatedRate>& rates) {
  return std::ranges::all_of(rates, [&](const StatedRate& rate) { return rate.hz == rates[0].hz; });
}

/// Returns cell `c` of a line.
std::string cell_at(std::string_view line, char separator, std::size_t c) {
  const Cells cells = cells_of(line, separator);
  return c < cells.size() ? cells[c] : "";
}

/// Looks for a table with one given separator.
class TableFinder {
 public:
  TableFinder(const TableText& text, char separator) : text_(text) { layout_.separator = separator; }

  std::optional<TableLayout> find() {
    if (!find_first_row()) return std::nullopt;
    above_ = layout_.first_row;
    if (!previous()) return std::nullopt;
    Cells names = names_at(above_);
    // Names between blanks stand above rows between tabs.
    if (const auto words = split_words(text_.lines[above_]); filled(names) == 1 && words.size() == width_)
      names.assign(words.begin(), words.end());
    Cells rates, units, periods;
    const auto is_rate = [](const std::string& cell) { return hertz_in_cell(cell).has_value(); };
    const auto is_period = [](const std::string& cell) { return period_in_cell(cell).has_value(); };
    // Rows of rates, sample periods and units stand below the names in any order. Some units may be unknown.
    for (bool more = true; more;)
      more = take_row(names, rates, is_rate) || take_row(names, periods, is_period) ||
             take_row(names, units, states_unit, 0.5);
    state_unknown_units(units);
    layout_.names_line = above_;
    layout_.end_row = text_.lines.size();
    names.resize(std::max(filled(names), width_));
    make_columns(names, units, rates, periods);
    read_head();
    return std::move(layout_);
  }

 private:
  [[nodiscard]] Cells row(std::size_t n) const { return cells_of(text_.lines[n], layout_.separator); }
  /// The cells of a row of names, without a mark of comments before the first: "# time".
  [[nodiscard]] Cells names_at(std::size_t n) const {
    Cells cells = row(n);
    if (cells.size() > 1)
      cells[0] = trim(std::string_view(cells[0]).substr(std::min(cells[0].find_first_not_of("#%/ "), cells[0].size())));
    return cells;
  }
  /// Returns true for a line of rules, also behind a mark of comments.
  [[nodiscard]] bool blank(std::size_t n) const {
    const std::string_view line = text_.lines[n];
    return is_rule(line.substr(std::min(line.find_first_not_of('#'), line.size())));
  }
  [[nodiscard]] bool numbers(const Cells& cells) const { return is_numbers(cells); }

  /// Finds the first row of numbers, and where there is none, of numbers beside texts that stand in every row.
  bool find_first_row() { return find_first_row(false) || find_first_row(true); }

  bool find_first_row(bool with_texts) {
    constexpr std::size_t kMost = 1000;
    const std::size_t most = std::min(text_.lines.size(), kMost);
    for (std::size_t n = 1; n < most; ++n) {
      if (text_.lines[n].find(layout_.separator) == std::string_view::npos) continue;
      const Cells cells = row(n);
      if (with_texts ? !begins_with_numbers(cells) : !numbers(cells)) continue;
      // A table begins where the next row that is not empty has the same width and holds numbers too.
      std::size_t next = n + 1;
      while (next < text_.lines.size() && blank(next)) ++next;
      width_ = filled(cells);
      if (next < text_.lines.size()) {
        const Cells below = row(next);
        const bool fits = with_texts ? below.size() == cells.size() && begins_with_numbers(below)
                                     : below.size() + 1 >= cells.size() && (numbers(below) || has_remark(below));
        if (!fits) continue;
        width_ = filled(below);
      }
      layout_.first_row = n;
      take_rows_with_remarks();
      return true;
    }
    return false;
  }

  /// Returns true for a row whose first two cells are numbers.
  [[nodiscard]] static bool begins_with_numbers(const Cells& cells) {
    return cells.size() > 2 && cell_number(cells[0]) && cell_number(cells[1]);
  }

  /// Returns true for a row that begins with a number and has text in one cell.
  [[nodiscard]] bool has_remark(const Cells& cells) const {
    const auto texts =
        std::ranges::count_if(cells, [&](const std::string& cell) { return !cell.empty() && !cell_number(cell); });
    return texts == 1 && cell_number(cells[0]);
  }

  /// Takes in rows with a remark in one cell that stand above the first row without one.
  void take_rows_with_remarks() {
    for (std::size_t n = layout_.first_row; n-- > 1;) {
      const Cells cells = row(n);
      if (cells.size() < width_ || !has_remark(cells)) return;
      layout_.first_row = n;
    }
  }

  bool previous() {
    while (above_ > 0 && blank(above_ - 1)) --above_;
    if (above_ == 0) return false;
    --above_;
    return true;
  }

  /// Takes the row `names` as `taken`, once, if `is` holds for all its cells; `names` becomes the row above it. With a
  /// `share` below 1 the rule need hold only for this share of the cells, where the row above has a name for each.
  template <typename Is>
  bool take_row(Cells& names, Cells& taken, const Is& is, double share = 1.0) {
    if (!taken.empty()) return false;
    const auto filled_in = [](const Cells& cells) {
      return cells.size() - static_cast<std::size_t>(std::ranges::count(cells, ""));
    };
    const std::size_t count = filled_in(names);
    const auto fitting = static_cast<std::size_t>(
        std::ranges::count_if(names, [&](const std::string& cell) { return !cell.empty() && is(cell); }));
    const std::size_t here = above_;
    const bool all = fitting == count;
    const bool enough = all || (fitting > 1 && static_cast<double>(fitting) >= share * static_cast<double>(count));
    if (fitting == 0 || !enough || !previous() || (!all && filled_in(row(above_)) < count)) {
      above_ = here;
      return false;
    }
    taken = std::exchange(names, names_at(above_));
    return true;
  }

  /// Returns true for a cell of a row of units.
  [[nodiscard]] static bool states_unit(const std::string& cell) {
    const TableColumn label = take_label_apart(cell);
    return unit_in_cell(cell) || (label.name.empty() && label.unit) || is_pattern_of_times(cell);
  }

  void state_unknown_units(const Cells& units) {
    std::set<std::string> unknown;
    for (const std::string& cell : units)
      if (!cell.empty() && !states_unit(cell)) unknown.insert(cell);
    if (!unknown.empty())
      layout_.repairs.push_back({above_ + 2, fmt::format("units that are not known: {}", fmt::join(unknown, ", "))});
  }

  void make_columns(const Cells& names, const Cells& units, const Cells& rates, const Cells& periods) {
    std::set<double> rounded;
    const std::vector<TableColumn> labels = take_labels_apart(names);
    for (std::size_t c = 0; c < names.size(); ++c) {
      TableColumn column = labels[c];
      if (column.rate_hz != std::floor(column.rate_hz)) rounded.insert(column.rate_hz);
      if (!column.unit && c < units.size()) column.unit = unit_in_cell(units[c]);
      if (c < rates.size()) column.rate_hz = rate_in_cell(rates[c]).value_or(column.rate_hz);
      if (c < periods.size() && !(column.rate_hz > 0.0))
        if (const auto period_s = period_in_cell(periods[c])) column.rate_hz = 1.0 / *period_s;
      layout_.columns.push_back(std::move(column));
    }
    set_kinds(layout_);
    keep_numbers();
    if (!rounded.empty())
      layout_.repairs.push_back(
          {layout_.names_line + 1,
           fmt::format("rates in whole Hz stand for whole samples in 27 ms: {:.7g} Hz", fmt::join(rounded, ", "))});
    const bool several_clocks = layout_.clocks() != Clocks::of_rows;
    if (several_clocks) layout_.short_row = ShortRow::ended;
    leave_out_counters(several_clocks);
    leave_out_texts_and_counts(text_, layout_);
    if (const auto devices = device_row()) put_devices_before_names(layout_, *devices);
  }

  /// Makes a channel of a column of remarks ("event") that holds a number in every row.
  void keep_numbers() {
    for (std::size_t c = 0; c < layout_.columns.size(); ++c) {
      TableColumn& column = layout_.columns[c];
      if (column.kind != Kind::remark) continue;
      const auto number = [&](std::string_view line) {
        return has_no_cell(line, layout_.separator) || line.starts_with('#') ||
               cell_number(cell_at(line, layout_.separator, c)).has_value();
      };
      const auto first = text_.lines.begin() + static_cast<std::ptrdiff_t>(layout_.first_row);
      if (std::all_of(first, text_.lines.end(), number)) column.kind = Kind::channel;
    }
  }

  /// Drops frame numbers that do not count the rows: they are no clock. Other numbers under such a name ("index") are
  /// a channel.
  void leave_out_counters(bool several_clocks) {
    const Cells first = row(layout_.first_row);
    const std::size_t next = layout_.first_row + 1;
    const Cells second = next < text_.lines.size() ? row(next) : Cells();
    const bool with_sub_frames = layout_.count(Kind::sub_frame) > 0;
    bool taken = false;
    for (std::size_t c = 0; c < layout_.columns.size(); ++c) {
      TableColumn& column = layout_.columns[c];
      if (column.kind != Kind::frame && column.kind != Kind::sub_frame) continue;
      const auto number = [&](const Cells& cells) {
        return c < cells.size() ? parse_number(cells[c]).value_or(kNan) : kNan;
      };
      const double begin = number(first), then = number(second);
      const bool counts = then == begin + 1.0 && column.kind == Kind::frame;
      if (!several_clocks && !with_sub_frames && counts && !taken) {
        taken = true;
        layout_.first_frame = begin == 0.0 ? 0.0 : 1.0;
        continue;
      }
      const bool measures = std::floor(begin) != begin || std::floor(then) != then || then < begin;
      column.kind = measures && !with_sub_frames && std::isfinite(begin + then) ? Kind::channel : Kind::left_out;
    }
  }

  /// Returns the row of sensor names, which stands above the row of their modes.
  [[nodiscard]] std::optional<Cells> device_row() const {
    for (std::size_t n = 1; n < layout_.names_line; ++n) {
      if (lower(trim(text_.lines[n])).starts_with("sensor mode")) return row(n - 1);
    }
    return std::nullopt;
  }

  /// Returns the last row above the names that begins with a label; it has a cell for each column.
  [[nodiscard]] Cells labeled_row(std::string_view label) const {
    for (std::size_t n = layout_.names_line; n-- > 0;)
      if (Cells cells = row(n); !cells.empty() && lower(cells[0]) == label) return cells;
    return {};
  }

  /// Reads the statements about channels and table in the lines above the names.
  void read_head() {
    std::map<std::string, std::optional<ScaledUnit>> known;
    std::vector<std::string_view> others;
    for (std::size_t n = 0; n < layout_.names_line; ++n) {
      const auto label = label_line(text_.lines[n]);
      if (label) known[label->name] = label->unit;
      if (!label) others.push_back(text_.lines[n]);
    }
    const std::vector<StatedRate> rates = rates_in_lines(others);
    const std::size_t end = layout_.names_line;
    const char separator = layout_.separator;
    const auto unit = unit_in_cell(stated_text(text_, end, separator, "measure unit"));
    const Cells of_columns = labeled_row("y_unit_label");
    for (std::size_t c = 0; c < layout_.columns.size(); ++c) {
      TableColumn& column = layout_.columns[c];
      if (column.kind != Kind::channel || column.unit) continue;
      const auto it = known.find(column.name);
      column.unit = it != known.end() ? it->second : c < of_columns.size() ? unit_in_cell(of_columns[c]) : unit;
    }
    if (rates.empty()) {
      const double rate = stated_number(text_, end, separator, {"frequency", "sampling rate"}).value_or(0.0);
      layout_.rate_hz = rate > 0.0 && rate <= 1e6 ? rate : 0.0;
    } else if (are_one(rates)) {
      layout_.rate_hz = rates[0].hz;
    }
    layout_.rows_said = stated_number(text_, end, separator, {"count", "number of samples"});
    layout_.length_s = stated_number(text_, end, separator, {"collection length (seconds)"});
    if (layout_.count(Kind::time) == 0 && layout_.rate_hz > 0.0)
      layout_.repairs.push_back(
          {0, fmt::format("no time column; the rate of {} Hz stated in the header is taken", layout_.rate_hz)});
  }

  const TableText& text_;
  TableLayout layout_;
  std::size_t width_ = 0;
  std::size_t above_ = 0;
};

/// Returns true if the first line that is no remark is a header with one time column, no other line of text follows, no
/// remark states a rate, and there is nothing to note.
bool is_plain(const TableText& text, const TableLayout& layout) {
  return next_line(text, 0) == layout.names_line && layout.rate_hz == 0.0 && layout.repairs.empty() &&
         !trim(text.lines[layout.names_line]).starts_with('%') && layout.count(Kind::time) == 1 &&
         std::ranges::all_of(layout.columns, [](const TableColumn& column) {
           return column.name.find(',') == std::string::npos &&
                  (column.kind == Kind::channel || (column.kind == Kind::time && names_plain_time(column.name)));
         });
}

/// Tries all separators and returns the widest table.
std::optional<TableLayout> find_table(const TableText& text) {
  std::optional<TableLayout> layout;
  for (const char separator : {'\t', ';', ','}) {
    auto found = TableFinder(text, separator).find();
    if (found && found->columns.size() > (layout ? layout->columns.size() : 1)) layout = std::move(found);
  }
  return layout;
}

/// Throws ReadError where commas both separate cells and mark decimals: "-88,9,15,4" below two
/// names has twice as many cells as names, and every second cell holds digits only.
void refuse_two_commas(const TableText& text, const TableLayout& layout, const std::filesystem::path& path) {
  const std::size_t names = filled(cells_of(text.lines[layout.names_line], layout.separator));
  const Cells first = cells_of(text.lines[layout.first_row], layout.separator);
  if (layout.separator != ',' || names == 0 || filled(first) != 2 * names) return;
  for (std::size_t i = 1; i < first.size(); i += 2) {
    if (first[i].empty() || first[i].find_first_not_of("0123456789") != std::string::npos) return;
  }
  throw ReadError(path, layout.first_row + 1,
                  fmt::format("{} cells below {} names: commas stand between cells and inside numbers; export with "
                              "semicolons or tabs, or with decimal points",
                              2 * names, names));
}

/// Throws ReadError where the table has no clock and the header states no rate in Hz or kHz, or several.
void refuse_other_rates(const TableText& text, const TableLayout& layout, const std::filesystem::path& path) {
  if (layout.count(Kind::time) > 0 || layout.rate_hz > 0.0) return;
  const auto rates = rates_in_lines(std::span(text.lines).first(layout.names_line));
  if (rates.empty()) return;
  if (!rates[0].other_unit.empty())
    throw ReadError(path, rates[0].line, "found a sampling rate in '{}', expected Hz or kHz; write it so",
                    rates[0].other_unit);
  for (const StatedRate& other : rates)
    if (other.hz != rates[0].hz)
      throw ReadError(path, other.line,
                      "this line states {} Hz and line {} {} Hz: which is the rate of the rows? Delete the other line",
                      other.hz, rates[0].line, rates[0].hz);
}

}  // namespace

CsvSeries parse_emg_table(std::string_view text, const std::filesystem::path& path) {
  TableText table(text);
  refuse_other_kinds(table, path);
  if (const auto layout = makers_layout(table, path)) return channels_of_table(table, *layout, path);
  std::vector<Event> events = take_discover_events(table);
  auto layout = find_table(table);
  if (layout) layout->events = std::move(events);
  if (!layout) {
    if (const auto tabs = tabs_for_blanks(table)) {
      CsvSeries series = parse_emg_table(*tabs, path);
      series.repairs.insert(series.repairs.begin(), {0, std::string(kBlanksSeparate)});
      return series;
    }
  }
  if (layout) {
    refuse_two_commas(table, *layout, path);
    refuse_other_rates(table, *layout, path);
  }
  if (layout && is_numbers(cells_of(table.lines[layout->names_line], layout->separator))) {
    throw ReadError(path, layout->names_line + 1,
                    "the table begins with numbers; expected a row of names above them, and a column 'time' or a line "
                    "'Sampling rate: 2000 Hz'");
  }
  if (!layout || is_plain(table, *layout)) return parse_csv_series(text, path);
  return channels_of_table(table, *layout, path);
}

}  // namespace myoid::recording
