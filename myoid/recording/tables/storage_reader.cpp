#include "myoid/recording/tables/storage_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/missing_value.h"
#include "myoid/recording/tables/storage_header.h"
#include "myoid/recording/tables/table_clock.h"
#include "myoid/recording/tables/table_layout.h"
#include "myoid/recording/tables/text_table.h"

namespace myoid::recording {
namespace {

enum class Cell { number, none, wrong };

enum class Before { blank, comma };

/// Reads the next number of a row and moves `at` behind it. Tabs and blanks separate cells, a comma
/// the elements of a cell.
Cell next_number(const char*& at, const char* end, Before before, bool elements, double& value) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (at != end && is_blank(*at)) ++at;
  if (before == Before::comma) {
    if (at == end || *at != ',') return at == end ? Cell::none : Cell::wrong;
    for (++at; at != end && is_blank(*at);) ++at;
  }
  if (at == end) return Cell::none;
  const char* begin = *at == '+' && at + 1 != end && at[1] != '-' ? at + 1 : at;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) {
    const auto tiny =
        parse_number({begin, static_cast<std::size_t>(stop - begin)});  // below the smallest double the value is 0
    if (!tiny) return Cell::wrong;
    value = *tiny;
  } else if (error != std::errc()) {
    return Cell::wrong;
  }
  if (stop != end && !is_blank(*stop) && !(elements && *stop == ',')) return Cell::wrong;
  at = stop;
  return Cell::number;
}

std::string_view word_at(const char* at, const char* end) {
  const char* stop = at;
  while (stop != end && *stop != '\t' && *stop != ' ') ++stop;
  return {at, static_cast<std::size_t>(stop - at)};
}

std::string_view text_between(const char* begin, const char* end) {
  return trim({begin, static_cast<std::size_t>(end - begin)});
}

/// Returns true for a row with commas and no point, such as "1,5<tab>2,25".
bool looks_like_comma_decimals(std::string_view line) {
  return line.find(',') != std::string_view::npos && line.find('.') == std::string_view::npos;
}

/// Returns true for labels that commas separate: the line has no tab, and more cells than words.
bool are_comma_labels(std::string_view line) {
  return line.find('\t') == std::string_view::npos &&
         split(line, ',').size() >= std::max<std::size_t>(2, split_words(line).size());
}

/// Returns true for labels that semicolons separate, as spreadsheets with decimal commas write them.
bool are_semicolon_labels(std::string_view line) {
  return line.find('\t') == std::string_view::npos && line.find(';') != std::string_view::npos;
}

/// Returns true for a row of `width` numbers that commas separate.
bool is_comma_row(std::string_view line, std::size_t width) {
  if (line.find('\t') != std::string_view::npos) return false;
  const auto cells = split(line, ',');
  return width > 1 && cells.size() == width &&
         std::ranges::all_of(cells, [](std::string_view cell) { return parse_number(cell).has_value(); });
}

std::size_t next_filled(const std::vector<std::string_view>& lines, std::size_t line) {
  while (line < lines.size() && trim(lines[line]).empty()) ++line;
  return line;
}

/// The columns of a storage file: the line of labels between header and rows.
struct Columns {
  std::vector<Channel> channels;  ///< One for each element of a cell, time excluded.
  std::size_t labels = 0;         ///< As written in the line, time included.
  std::size_t line = 0;           ///< Counted from 1.
  std::size_t first_row = 0;      ///< Index of the first row of numbers.
  bool comma_cells = false;       ///< Commas separate the cells.
  std::vector<Repair> repairs;

  [[nodiscard]] std::size_t width() const { return channels.size() + 1; }
};

/// Splits the line of labels. Where tabs and blanks are mixed ("time <tab><tab> a b"), the labels are those that are as
/// many as the numbers of the first row: the cells between tabs, these without the empty ones, the cells between tabs
/// or two blanks, or the words. A label that is empty stays only where none of these fits.
std::vector<std::string> labels_of(std::string_view line, bool comma_cells, std::size_t numbers) {
  const auto trimmed = [](std::vector<std::string_view> cells) {
    for (std::string_view& cell : cells) cell = trim(cell);
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    return std::vector<std::string>(cells.begin(), cells.end());
  };
  if (line.find('\t') == std::string_view::npos)
    return trimmed(comma_cells ? split(trim(line), ',') : split_words(line));
  // An empty label above numbers that all have a label is that of a data frame's index; it stays.
  if (line.starts_with('\t') && trimmed(split(line, '\t')).size() == numbers) return trimmed(split(line, '\t'));
  const std::vector<std::string> cells = trimmed(split(trim(line), '\t'));
  std::vector<std::string> filled = cells, wide;
  std::erase(filled, "");
  if (filled.size() == numbers) return filled;
  for (std::string_view cell : filled) {
    for (std::size_t end = 0; !cell.empty(); cell = trim(cell.substr(end))) {
      end = std::min(cell.find("  "), cell.size());
      wide.emplace_back(cell.substr(0, end));
    }
  }
  if (wide.size() == numbers) return wide;
  const std::vector<std::string> words = trimmed(split_words(line));
  return words.size() == numbers && cells.size() != numbers ? words : cells;
}

Columns read_columns(const std::vector<std::string_view>& lines,
                     const StorageHeader& header,
                     const std::filesystem::path& path) {
  const std::size_t at = next_filled(lines, header.end + 1);
  if (at >= lines.size()) throw ReadError(path, at, "the file ends after its header: expected the column labels");
  Columns columns;
  columns.line = at + 1;
  columns.comma_cells = header.elements == 1 && are_comma_labels(lines[at]);
  columns.first_row = next_filled(lines, at + 1);
  const std::size_t numbers = columns.first_row < lines.size() ? split_words(lines[columns.first_row]).size() : 0;
  std::vector<std::string> names = labels_of(lines[at], columns.comma_cells, numbers);
  columns.labels = names.size();
  if (names.size() > 1 && names[0].empty())
    throw ReadError(
        path, columns.line,
        fmt::format("numbers stand in the first column, which has no label: the index of a data frame; write "
                    "the file without it, '{}' first",
                    names[1]));
  if (names.empty() || !equal_ignoring_case(names[0], "time")) {
    throw ReadError(path, columns.line,
                    fmt::format("expected the first column to be 'time', found '{}'", names.empty() ? "" : names[0]));
  }
  if (names[0] != "time")
    columns.repairs.push_back({columns.line, fmt::format("column '{}' read as 'time'", names[0])});
  for (std::size_t c = 1; c < names.size(); ++c)
    if (names[c].empty()) names[c] = fmt::format("column_{}", c + 1);
  names.erase(names.begin());
  for (const std::string& name : unique_names(names, "column", columns.line, columns.repairs)) {
    if (header.elements == 1) columns.channels.push_back({name, Unit::dimensionless});
    for (std::size_t e = 1; header.elements > 1 && e <= header.elements; ++e)
      columns.channels.push_back({fmt::format("{}_{}", name, e), Unit::dimensionless});
  }
  if (header.elements == 1)
    compare_count(header.count({"nColumns", "datacolumns"}), columns.labels, "columns", columns.repairs);
  if (header.elements == 1 && columns.first_row < lines.size() &&
      is_comma_row(lines[columns.first_row], columns.width()))
    columns.comma_cells = true;
  if (columns.comma_cells) columns.repairs.push_back({columns.line, "separated by commas instead of tabs"});
  return columns;
}

/// Reads the rows of numbers and keeps the first line of each kind of repair.
class StorageRows {
 public:
  StorageRows(const Columns& columns, const StorageHeader& header, const std::filesystem::path& path)
      : columns_(columns),
        path_(path),
        elements_(header.elements),
        width_(columns.width()),
        rows_said_(header.count({"nRows", "datarows"})),
        row_(width_) {}

  void read(const TableText& text, std::size_t bytes) {
    const auto& lines = text.lines;
    const std::size_t most = std::min(lines.size() - std::min(lines.size(), columns_.first_row),
                                      bytes / (2 * width_ - 1) + 1);  // a number and a separator for each cell
    values_.resize(static_cast<Eigen::Index>(most), static_cast<Eigen::Index>(width_ - 1));
    for (std::size_t line = columns_.first_row; line < lines.size(); ++line) {
      if (trim(lines[line]).empty()) continue;
      if (line + 1 == lines.size() && !text.ends_with_line && !keeps_last(text, lines[line])) break;
      read_row(lines[line], line + 1);
      keep_row(line + 1);
    }
    if (time_.empty()) throw ReadError(path_, 0, "there are no rows of numbers after the column labels");
    if (repeated_line_ > 0) repeated_ = settle_repeats(time_, values_, 0.0);
    state_what_was_mended();
  }

  [[nodiscard]] const std::vector<Repair>& repairs() const { return repairs_; }

  [[nodiscard]] TimeSeries series() {
    const auto count = static_cast<Eigen::Index>(time_.size());
    values_.conservativeResize(count, Eigen::NoChange);
    std::vector<Channel> channels = columns_.channels;
    std::vector<std::string> names;
    for (const Channel& channel : channels) names.push_back(channel.name);
    const auto missing = take_out_missing(values_, names, repairs_);
    for (std::size_t c = 0; c < channels.size(); ++c) channels[c].missing = missing[c];
    return {Eigen::Map<const Eigen::VectorXd>(time_.data(), count), std::move(channels), std::move(values_)};
  }

 private:
  [[nodiscard]] std::size_t count() const { return time_.size() + repeated_; }

  bool keeps_last(const TableText& text, std::string_view row) {
    const bool counted = !rows_said_ || *rows_said_ == static_cast<double>(count() + 1);
    const std::size_t cells = elements_ > 1 || columns_.comma_cells ? split(row, ',').size() : split_words(row).size();
    const std::size_t whole = elements_ > 1 ? width_ - columns_.labels + 1 : width_;
    const LastRow last = last_row_without_end(text, counted && cells >= whole, time_.empty());
    repairs_.push_back(last.note);
    return last.kept;
  }

  /// Fills `row_`. Throws ReadError for a number that is missing or wrong.
  void read_row(std::string_view content, std::size_t line) {
    if (columns_.comma_cells || (elements_ == 1 && looks_like_comma_decimals(content))) {
      mended_.assign(content);
      std::ranges::replace(mended_, ',', columns_.comma_cells ? '\t' : '.');
      content = mended_;
      if (!columns_.comma_cells) mark(comma_line_, line);
    }
    const char* at = content.data();
    const char* const end = at + content.size();
    for (std::size_t c = 0; c < width_; ++c) {
      const bool element = c > 0 && (c - 1) % elements_ != 0;
      double value = 0.0;
      const Cell cell = next_number(at, end, element ? Before::comma : Before::blank, elements_ > 1, value);
      if (cell != Cell::number) refuse(cell, c, line, word_at(at, end));
      if (!std::isfinite(value)) {
        if (c == 0) throw ReadError(path_, line, "the time is not a number");
        mark(nan_line_, line);
        value = kNan;
      }
      row_[c] = value;
    }
    const bool doubled = text_between(content.data(), at).find("\t\t") != std::string_view::npos;
    if (doubled) mark(doubled_line_, line);
    if (!text_between(at, end).empty()) judge_surplus(doubled, line);
  }

  [[noreturn]] void refuse(Cell cell, std::size_t column, std::size_t line, std::string_view found) const {
    if (cell == Cell::none)
      throw ReadError(
          path_, line,
          fmt::format("expected {} numbers, found {}; the row is cut off or a cell is empty", width_, column));
    throw ReadError(path_, line,
                    fmt::format("expected a number in column {} ('{}'), found '{}'", column + 1,
                                column == 0 ? "time" : columns_.channels[column - 1].name, found));
  }

  /// Ignores numbers behind the last column, unless a cell of the row may be missing.
  void judge_surplus(bool doubled, std::size_t line) {
    if (columns_.comma_cells)
      throw ReadError(path_, line,
                      fmt::format("more than {} numbers; decimal commas in a file separated by commas?", width_));
    if (doubled)
      throw ReadError(
          path_, line,
          fmt::format("a cell is empty and there are more than {} numbers: which belongs to which column?", width_));
    mark(extra_line_, line);
  }

  /// Appends `row_`. Times that differ by less than 1e-10 s differ only by rounding.
  void keep_row(std::size_t line) {
    constexpr double kSameTime_s = 1e-10;
    if (!time_.empty() && row_[0] <= time_.back() + kSameTime_s) {
      if (row_[0] < time_.back() - kSameTime_s)
        throw ReadError(path_, line,
                        fmt::format("time goes backwards: {} s after {} s; sort the rows or split the file", row_[0],
                                    time_.back()));
      mark(repeated_line_, line);
      row_[0] = time_.back();
    }
    const auto index = static_cast<Eigen::Index>(time_.size());
    time_.push_back(row_[0]);
    for (std::size_t c = 1; c < width_; ++c) values_(index, static_cast<Eigen::Index>(c - 1)) = row_[c];
  }

  void state_what_was_mended() {
    note(repeated_line_, repeated_ > 0 ? "a time stands twice; the first row is kept"
                                       : "the times are rounded, so that rows share them: the rows are taken as even");
    if (repeated_ > 1) repairs_.push_back({0, fmt::format("{} rows in all repeat a time and were dropped", repeated_)});
    note(comma_line_, "comma decimals read as decimal points");
    note(doubled_line_, "two tabs in a row taken as one, since the numbers are as many as the columns");
    note(extra_line_, "more numbers than columns; the surplus is ignored");
    note(nan_line_, "a value is not a number; kept as a gap");
    compare_count(rows_said_, count(), "rows", repairs_);
  }

  static void mark(std::size_t& first, std::size_t line) {
    if (first == 0) first = line;
  }
  void note(std::size_t line, const char* message) {
    if (line > 0) repairs_.push_back({line, message});
  }

  const Columns& columns_;
  const std::filesystem::path& path_;
  std::size_t elements_, width_;
  std::optional<double> rows_said_;
  std::vector<double> row_, time_;
  Eigen::MatrixXd values_;
  std::string mended_;
  std::vector<Repair> repairs_;
  std::size_t repeated_ = 0;
  std::size_t extra_line_ = 0, nan_line_ = 0, comma_line_ = 0, doubled_line_ = 0, repeated_line_ = 0;
};

}  // namespace

Storage parse_storage(std::string_view text, const std::filesystem::path& path) {
  const TableText table(text);
  if (table.lines.empty()) throw ReadError(path, 0, "the file has no lines; export it again");
  StorageHeader header = read_storage_header(table.lines, path);
  const std::size_t labels = next_filled(table.lines, header.end + 1);
  if (labels < table.lines.size() && are_semicolon_labels(table.lines[labels])) {
    std::string tabs(text);
    std::ranges::replace(tabs, ';', '\t');
    Storage storage = parse_storage(tabs, path);
    storage.repairs.push_back({labels + 1, "separated by semicolons instead of tabs"});
    return storage;
  }
  const Columns columns = read_columns(table.lines, header, path);
  StorageRows rows(columns, header, path);
  rows.read(table, text.size());
  Storage storage = std::move(header.file);
  storage.data = rows.series();
  for (const auto* repairs : {&columns.repairs, &rows.repairs()})
    storage.repairs.insert(storage.repairs.end(), repairs->begin(), repairs->end());
  return storage;
}

Storage read_storage(const std::filesystem::path& path) { return parse_storage(read_text_file(path), path); }

TimeSeries to_si(const Storage& storage, const std::function<bool(const std::string&)>& is_angle, Unit other) {
  std::vector<Channel> channels = storage.data.channels();
  Eigen::MatrixXd values = storage.data.values();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (is_angle(channels[c].name)) {
      channels[c].unit = Unit::radian;
      if (storage.in_degrees) values.col(static_cast<Eigen::Index>(c)) *= kDegree;
    } else {
      channels[c].unit = other;
    }
  }
  return {storage.data.time_s(), std::move(channels), std::move(values)};
}

}  // namespace myoid::recording
