#include "myoid/recording/makers/labchart_layout.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/tables/channel_labels.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

/// The lines above a block of rows.
struct BlockHead {
  std::size_t line = 0;  ///< Of the titles, counted from 0.
  std::vector<std::string> titles, units, ranges;
  std::optional<double> interval_s;
  std::optional<double> date_days;  ///< "ExcelDateTime=".
  std::size_t first_row = 0, end_row = 0;
};

/// Returns the key of a line "Key=<separator>...", without the sign.
std::string_view key_of(std::string_view line) {
  const std::size_t end = line.find('=');
  if (end == std::string_view::npos || end == 0) return {};
  const std::string_view key = line.substr(0, end);
  const bool letters =
      std::ranges::all_of(key, [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); });
  return letters ? key : std::string_view();
}

std::optional<double> number_in(const std::string& cell, char separator) {
  if (const auto number = parse_number(cell)) return number;
  return separator == ',' ? std::nullopt : parse_comma_number(cell);
}

/// Reads the key of a line into the head; cells of the line are its values.
void take_key(std::string_view key, std::vector<std::string> cells, std::size_t line, char separator, BlockHead& head) {
  cells.erase(cells.begin());
  if (key == "ChannelTitle") {
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    head.titles = std::move(cells);
    head.line = line;
  } else if (key == "UnitName") {
    head.units = std::move(cells);
  } else if (key == "Range") {
    head.ranges = std::move(cells);
  } else if (key == "Interval" && !cells.empty()) {
    head.interval_s = period_in_cell(cells[0]);
  } else if (key == "ExcelDateTime" && !cells.empty()) {
    head.date_days = number_in(cells[0], separator);
  }
}

/// Finds the blocks and blanks the lines of all heads behind the first row.
std::vector<BlockHead> take_blocks(TableText& text, char separator) {
  std::vector<BlockHead> blocks(1);
  bool in_rows = false;
  for (std::size_t n = 0; n < text.lines.size(); ++n) {
    const std::string_view key = key_of(text.lines[n]);
    if (key.empty()) {
      if (!in_rows && !is_rule(text.lines[n])) {
        in_rows = true;
        blocks.back().first_row = n;
      }
      continue;
    }
    if (in_rows) {
      blocks.back().end_row = n;
      blocks.emplace_back();
      in_rows = false;
    }
    take_key(key, cells_of(text.lines[n], separator), n, separator, blocks.back());
    if (blocks.size() > 1) text.lines[n] = "#";
  }
  blocks.back().end_row = text.lines.size();
  if (!in_rows) blocks.pop_back();
  return blocks;
}

void require_equal_channels(const std::vector<BlockHead>& blocks, const std::filesystem::path& path) {
  for (const BlockHead& block : blocks) {
    if (!block.titles.empty() && block.titles != blocks[0].titles)
      throw ReadError(path, block.line + 1,
                      "the channels differ from those of the first block ({}); export each block alone",
                      fmt::join(blocks[0].titles, ", "));
  }
}

/// A comment at the end of a row.
struct Comment {
  std::size_t line = 0;  ///< Counted from 0.
  std::string text;
};

/// Cuts the comments off the rows: "#* text" of all channels, "#3 text" of one.
std::vector<Comment> take_comments(TableText& text, std::size_t first, char separator) {
  std::vector<Comment> comments;
  for (std::size_t n = first; n < text.lines.size(); ++n) {
    std::string_view& line = text.lines[n];
    std::size_t at = line.find('#');
    while (at != std::string_view::npos && at > 0 && line[at - 1] != separator && line[at - 1] != ' ' &&
           line[at - 1] != '"')
      at = line.find('#', at + 1);
    if (at == std::string_view::npos || at == 0) continue;
    std::string_view said = line.substr(at + 1);
    const std::size_t tag = said.find_first_not_of("*0123456789");
    if (tag != std::string_view::npos) said.remove_prefix(tag);
    while (said.ends_with('"') || said.ends_with(separator)) said.remove_suffix(1);
    comments.push_back({n, std::string(trim(said))});
    line = line.substr(0, at);
    while (!line.empty() && (line.back() == '"' || line.back() == ' ')) line.remove_suffix(1);
    if (line.ends_with(separator)) line.remove_suffix(1);
  }
  return comments;
}

/// Returns the columns: perhaps a time and a date, then the channels.
std::vector<TableColumn> columns_of(const BlockHead& head,
                                    const std::vector<std::string>& row,
                                    char separator,
                                    const std::filesystem::path& path,
                                    std::vector<Repair>& repairs) {
  const std::size_t channels = head.titles.size();
  if (row.size() < channels || row.size() > channels + 2)
    throw ReadError(path, head.first_row + 1, "{} cells below {} channels in 'ChannelTitle='; expected {} or {}",
                    row.size(), channels, channels, channels + 1);
  std::vector<TableColumn> columns;
  bool timed = false;
  for (std::size_t c = 0; c + channels < row.size(); ++c) {
    const bool number = !timed && number_in(row[c], separator).has_value();
    columns.push_back({number ? Kind::time : Kind::left_out, number ? "Time" : c == 0 ? "time of day" : "date"});
    timed = timed || number;
  }
  std::vector<std::string> by_range;
  for (std::size_t c = 0; c < channels; ++c) {
    TableColumn column{Kind::channel, head.titles[c]};
    const std::string unit = c < head.units.size() ? head.units[c] : "";
    if (!unit.empty() && unit != "*") {
      column.unit = unit_in_cell(unit);
    } else if (c < head.ranges.size()) {
      const auto words = split_words(head.ranges[c]);
      if (words.size() > 1) column.unit = unit_in_cell(words.back());
      if (column.unit) by_range.push_back(column.name);
    }
    columns.push_back(std::move(column));
  }
  if (!by_range.empty())
    repairs.push_back({head.line + 1, fmt::format("no converted unit is stated; the unit of the range is taken for {}",
                                                  fmt::join(by_range, ", "))});
  return columns;
}

/// Puts the blocks one behind another and notes the pauses.
class Blocks {
 public:
  Blocks(const TableText& text, char separator, TableLayout& layout)
      : text_(text), separator_(separator), layout_(layout) {}

  void place(const std::vector<BlockHead>& blocks) {
    double end_s = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const BlockHead& block = blocks[b];
      double begin_s = 0.0;
      if (b > 0) begin_s = begin_of(block, blocks[0], b + 1, end_s);
      layout_.blocks.push_back({block.first_row + 1, begin_s});
      const double interval_s = block.interval_s.value_or(0.0);
      end_s = begin_s + last_time(block) + interval_s;
    }
  }

  /// Returns the time of a row on the clock of the file [s].
  [[nodiscard]] double time_of(const std::vector<BlockHead>& blocks, std::size_t line) const {
    std::size_t b = blocks.size() - 1;
    while (b > 0 && line < blocks[b].first_row) --b;
    return layout_.blocks[b].begin_s + cell_time(line, blocks[b]);
  }

 private:
  [[nodiscard]] bool timed() const { return layout_.columns[0].kind == Kind::time; }

  [[nodiscard]] double cell_time(std::size_t line, const BlockHead& block) const {
    if (timed()) return number_in(cells_of(text_.lines[line], separator_)[0], separator_).value_or(0.0);
    return static_cast<double>(line - block.first_row) / layout_.rate_hz;
  }

  [[nodiscard]] double last_time(const BlockHead& block) const {
    std::size_t last = block.end_row - 1;
    while (last > block.first_row && is_rule(text_.lines[last])) --last;
    return cell_time(last, block);
  }

  double begin_of(const BlockHead& block, const BlockHead& first, std::size_t number, double end_s) {
    constexpr double kDay_s = 86400.0;
    constexpr double kPause_s = 1.0;
    const double first_s = cell_time(block.first_row, block);
    const double half_s = 0.5 * block.interval_s.value_or(0.0);
    if (timed() && first_s > end_s - half_s) return 0.0;  // its times go on from those of the block before
    const double dated_s = block.date_days && first.date_days ? (*block.date_days - *first.date_days) * kDay_s : 0.0;
    const bool dated = dated_s + first_s > end_s - half_s;
    const double begin_s = dated ? dated_s : end_s - first_s + kPause_s;
    layout_.repairs.push_back(
        {block.first_row + 1,
         dated
             ? fmt::format("block {}: the recording pauses from {:.6g} s to {:.6g} s", number, end_s, begin_s + first_s)
             : fmt::format(
                   "block {}: the file does not say how long the recording paused; here it begins {:g} s behind "
                   "the block before, at {:.6g} s",
                   number, kPause_s, begin_s + first_s)});
    return begin_s;
  }

  const TableText& text_;
  char separator_;
  TableLayout& layout_;
};

}  // namespace

std::optional<TableLayout> labchart_layout(TableText& text, const std::filesystem::path& path) {
  constexpr std::size_t kHeader = 20;
  constexpr std::string_view kTitles = "ChannelTitle=";
  const auto end = text.lines.begin() + static_cast<std::ptrdiff_t>(std::min(text.lines.size(), kHeader));
  const auto titles = std::find_if(text.lines.begin(), end, [&](std::string_view l) { return l.starts_with(kTitles); });
  if (titles == end || titles->size() <= kTitles.size()) return std::nullopt;
  TableLayout layout;
  layout.separator = (*titles)[kTitles.size()];
  const std::vector<BlockHead> blocks = take_blocks(text, layout.separator);
  if (blocks.empty() || blocks[0].titles.empty())
    throw ReadError(path, 1, "there are no rows of numbers below 'ChannelTitle='");
  require_equal_channels(blocks, path);
  const std::vector<Comment> comments = take_comments(text, blocks[0].first_row, layout.separator);
  layout.names_line = blocks[0].line;
  layout.first_row = blocks[0].first_row;
  layout.end_row = text.lines.size();
  std::vector<std::string> first = cells_of(text.lines[layout.first_row], layout.separator);
  while (first.size() > blocks[0].titles.size() + 1 && first.back().empty()) first.pop_back();
  layout.columns = columns_of(blocks[0], first, layout.separator, path, layout.repairs);
  layout.rate_hz = blocks[0].interval_s ? 1.0 / *blocks[0].interval_s : 0.0;
  if (layout.columns[0].kind != Kind::time && !(layout.rate_hz > 0.0))
    throw ReadError(path, 1, "neither times nor 'Interval=' are in the file; export it with its times");
  Blocks places(text, layout.separator, layout);
  places.place(blocks);
  for (const Comment& comment : comments)
    layout.events.push_back({places.time_of(blocks, comment.line), comment.text, "", ""});
  return layout;
}

}  // namespace myoid::recording
