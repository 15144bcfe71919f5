#include "myoid/recording/tables/read_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/missing_value.h"
#include "myoid/ground/files/written_time.h"

namespace myoid::recording {
namespace {

/// Copies a row. A matrix without columns is skipped: a row of it would refer to memory behind its data.
void copy_row(Eigen::Index from, Eigen::Index to, Eigen::MatrixXd& matrix) {
  for (Eigen::Index c = 0; c < matrix.cols(); ++c) matrix(to, c) = matrix(from, c);
}

enum class CellKind : std::uint8_t {
  number,
  comma_number,
  thousands,  ///< A number whose comma may stand before decimals or before the last three digits of a thousand.
  gap,
  wrong
};

/// Returns true for "1,234", which "0,234" and "1,23" are not.
bool may_be_thousands(std::string_view cell) {
  if (cell.starts_with('-') || cell.starts_with('+')) cell.remove_prefix(1);
  constexpr std::size_t kGroup = 3;
  const std::size_t comma = cell.find(',');
  return comma > 0 && comma <= kGroup && cell.size() == comma + 1 + kGroup && cell.front() != '0';
}

/// Returns true for digits with signs of decimals and thousands of any country: "2'436.5", "2.436,518".
bool has_thousands(std::string_view cell) {
  std::string rest(cell);
  for (const std::string_view mark : {"\u00a0", "\u202f", "\u2019"})  // blanks that do not break, an apostrophe
    for (std::size_t at = rest.find(mark); at != std::string::npos; at = rest.find(mark))
      rest.replace(at, mark.size(), "'");
  return rest.find_first_not_of("+-0123456789,.' ") == std::string::npos &&
         rest.find_first_of("0123456789") != std::string::npos;
}

CellKind read_cell(std::string_view cell, char separator, double& value) {
  const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  if (quoted) cell = trim(cell.substr(1, cell.size() - 2));
  value = kNan;
  if (cell.empty() || is_gap_word(cell)) return CellKind::gap;
  if (const auto number = parse_number(cell)) {
    value = *number;
    return CellKind::number;
  }
  const auto number = separator == ',' && !quoted ? std::nullopt : parse_comma_number(cell);
  if (!number) return CellKind::wrong;
  value = *number;
  return separator == ',' && may_be_thousands(cell) ? CellKind::thousands : CellKind::comma_number;
}

struct RowScan {
  std::uint32_t cells = 0;   ///< Number of cells.
  std::uint32_t filled = 0;  ///< Cells up to the last filled one.
  bool blank = true;         ///< All cells are empty.
  bool comma = false, thousands = false, gap = false, wrong = false, remark = false, day = false;
};

struct ColumnUse {
  enum class Kind : std::uint8_t { none, clock, value, remark } kind = Kind::none;
  Eigen::Index target = 0;

  [[nodiscard]] bool is_number() const { return kind == Kind::clock || kind == Kind::value; }
};

class RowReader {
 public:
  RowReader(const TableText& text, const TableRows& rows, const std::filesystem::path& path)
      : text_(text), rows_(rows), path_(path), uses_(rows.names.size()) {
    const auto use = [&](const std::vector<std::size_t>& columns, ColumnUse::Kind kind) {
      for (std::size_t k = 0; k < columns.size(); ++k) uses_[columns[k]] = {kind, static_cast<Eigen::Index>(k)};
    };
    use(rows.clock, ColumnUse::Kind::clock);
    use(rows.values, ColumnUse::Kind::value);
    use(rows.texts, ColumnUse::Kind::remark);
  }

  TableNumbers read() {
    end_ = std::min(rows_.end, text_.lines.size());
    while (end_ > rows_.first && is_left_out(end_ - 1)) --end_;
    leave_out_foot();
    const std::size_t count = end_ - std::min(end_, rows_.first);
    scans_.resize(count);
    numbers_.clock.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(rows_.clock.size()));
    numbers_.values.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(rows_.values.size()));
    parallel_ranges(count, std::size_t{256}, [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) scan(i);
    });
    judge();
    std::vector<std::string> names;
    for (const std::size_t column : rows_.values) names.push_back(rows_.names[column]);
    numbers_.missing = take_out_missing(numbers_.values, names, numbers_.repairs);
    state_what_was_mended();
    return std::move(numbers_);
  }

 private:
  [[nodiscard]] std::size_t width() const { return rows_.names.size(); }
  void note(std::size_t line, std::string message) { numbers_.repairs.push_back({line, std::move(message)}); }
  [[nodiscard]] std::string_view line_of(std::size_t i) const { return text_.lines[rows_.first + i]; }

  /// Returns true for blank lines, remarks and empty rows at the end of a table.
  [[nodiscard]] bool is_left_out(std::size_t n) const {
    const std::string_view line = text_.lines[n];
    if (line.find(rows_.separator) == std::string_view::npos) return trim(line).empty();
    return !rows_.empty_row_is_gap && has_no_cell(line, rows_.separator);
  }

  /// Returns true for a line whose first cell of the clock begins as a word.
  [[nodiscard]] bool is_foot(std::size_t n) const {
    const auto cells = cells_of(text_.lines[n], rows_.separator);
    const std::size_t c = rows_.clock.empty() || rows_.clock[0] >= cells.size() ? 0 : rows_.clock[0];
    const bool number = c < uses_.size() && uses_[c].is_number();
    return number && !cells[c].empty() && is_letter(cells[c][0]) && !is_gap_word(cells[c]) && !parse_number(cells[c]);
  }

  /// Leaves out lines behind the samples: sums, means, "End of file".
  void leave_out_foot() {
    constexpr std::size_t kMost = 20;
    std::size_t foot = end_;
    while (foot > rows_.first && end_ - foot <= kMost && (is_left_out(foot - 1) || is_foot(foot - 1))) --foot;
    if (foot == end_ || foot == rows_.first || end_ - foot > kMost) return;
    end_ = foot;
    while (is_left_out(foot)) ++foot;
    note(foot + 1, fmt::format("'{}' begins no row of samples; it and what follows is left out",
                               trim(text_.lines[foot].substr(0, text_.lines[foot].find(rows_.separator)))));
    while (is_left_out(end_ - 1)) --end_;
  }

  /// Returns true for a line of the header that stands between rows again.
  [[nodiscard]] bool repeats_header(std::size_t i) const {
    constexpr std::size_t kLines = 3;  // names, units, rates
    const std::size_t from = rows_.first - std::min(rows_.first, kLines);
    const auto end = text_.lines.begin() + static_cast<std::ptrdiff_t>(rows_.first);
    return std::find(text_.lines.begin() + static_cast<std::ptrdiff_t>(from), end, line_of(i)) != end;
  }

  void put(const ColumnUse& use, Eigen::Index row, double value) {
    if (use.kind == ColumnUse::Kind::clock) numbers_.clock(row, use.target) = value;
    if (use.kind == ColumnUse::Kind::value) numbers_.values(row, use.target) = value;
  }

  /// Reads a number that ends at the separator, which is the usual cell, and moves `at` behind it.
  [[nodiscard]] bool plain_number(const char*& at, const char* end, double& value) const {
    const char* begin = at;
    while (begin != end && *begin == ' ') ++begin;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || !std::isfinite(value)) return false;
    const char* behind = stop;
    while (behind != end && *behind == ' ') ++behind;
    if (behind != end && *behind != rows_.separator) return false;
    at = behind;
    return true;
  }

  void scan(std::size_t i) {
    const std::string_view line = line_of(i);
    RowScan& row = scans_[i];
    const auto index = static_cast<Eigen::Index>(i);
    const char* at = line.data();
    const char* const end = at + line.size();
    for (std::size_t c = 0;; ++c) {
      const ColumnUse use = c < uses_.size() ? uses_[c] : ColumnUse{};
      double value = kNan;
      bool empty = false;
      if (!use.is_number() || !plain_number(at, end, value)) {
        const std::string_view cell = next_cell(at, end, rows_.separator);
        empty = cell.empty() || cell == "\"\"";
        if (use.is_number()) {
          CellKind kind = read_cell(cell, rows_.separator, value);
          if (kind == CellKind::wrong && use.kind == ColumnUse::Kind::clock) {
            if (const auto time = written_time_s(cell)) {
              value = *time;
              kind = CellKind::number;
              row.day = true;
            }
          }
          row.comma = row.comma || kind == CellKind::comma_number;
          row.thousands = row.thousands || kind == CellKind::thousands;
          row.wrong = row.wrong || kind == CellKind::wrong;
        } else if (use.kind == ColumnUse::Kind::remark) {
          row.remark = row.remark || !empty;
        }
      }
      if (use.kind == ColumnUse::Kind::value) row.gap = row.gap || !std::isfinite(value);
      put(use, index, value);
      ++row.cells;
      if (!empty) row.filled = row.cells;
      if (at == end) break;
      ++at;
    }
    row.blank = row.filled == 0;
    for (std::size_t c = row.cells; c < uses_.size(); ++c) put(uses_[c], index, kNan);
  }

  /// Decides row by row which rows are kept, and moves these together.
  void judge() {
    Eigen::Index kept = 0;
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      const RowScan& row = scans_[i];
      if (line_of(i).starts_with('#')) continue;
      if (row.blank && !(rows_.empty_row_is_gap && row.cells > 1)) {
        if (row.cells > 1) {
          throw ReadError(path_, rows_.first + i + 1,
                          "the row is empty and other rows follow; expected a number in each cell of the clock");
        }
        if (kept > 0 && blank_line_++ == 0) first_blank_ = rows_.first + i + 1;
        continue;
      }
      if (row.wrong && repeats_header(i)) {
        if (header_line_ == 0) header_line_ = rows_.first + i + 1;
        continue;
      }
      if (!keeps(i, kept)) break;
      if (row.wrong) refuse_cell(i);
      if (row.thousands && thousands_line_ == 0) thousands_line_ = rows_.first + i + 1;
      if (row.comma && comma_line_ == 0) comma_line_ = rows_.first + i + 1;
      if (row.day && day_line_ == 0) day_line_ = rows_.first + i + 1;
      if (row.gap && gap_line_ == 0) gap_line_ = rows_.first + i + 1;
      if (row.remark) take_remarks(i, static_cast<std::size_t>(kept));
      if (kept != static_cast<Eigen::Index>(i)) {
        copy_row(static_cast<Eigen::Index>(i), kept, numbers_.clock);
        copy_row(static_cast<Eigen::Index>(i), kept, numbers_.values);
      }
      numbers_.lines.push_back(rows_.first + i + 1);
      ++kept;
    }
    if (kept == 0) throw ReadError(path_, rows_.first + 1, "there are no rows of numbers");
    if (kept < numbers_.values.rows()) {
      numbers_.clock.conservativeResize(kept, Eigen::NoChange);
      numbers_.values.conservativeResize(kept, Eigen::NoChange);
    }
  }

  /// Returns true if the row is kept; false for a last row that is cut off. Throws if its width is wrong.
  bool keeps(std::size_t i, Eigen::Index kept) {
    const RowScan& row = scans_[i];
    const std::size_t line = rows_.first + i + 1;
    const bool last = i + 1 == scans_.size();
    const bool without_end = last && line == text_.lines.size() && !text_.ends_with_line;
    if (without_end) {
      const bool counted = !rows_.rows_said || *rows_.rows_said == static_cast<double>(kept + 1);
      LastRow judged = last_row_without_end(text_, counted && row.cells == width(), kept == 0);
      numbers_.repairs.push_back(std::move(judged.note));
      if (!judged.kept) return false;
    }
    if (row.filled > width())
      throw ReadError(
          path_, line,
          fmt::format("{} cells, expected {} as in the header{}", row.filled, width(),
                      rows_.separator == ',' ? "; a cell too many, or decimal commas in a table separated by commas"
                                             : "; a cell is too many"));
    if (row.cells >= width()) return true;
    if (last && kept > 0 && rows_.short_row != ShortRow::ended) {
      note(line, fmt::format("the last row has {} of {} cells and is left out", row.cells, width()));
      return false;
    }
    const bool triples = row.cells >= rows_.first_triple && (row.cells - rows_.first_triple) % 3 == 0;
    if (rows_.short_row == ShortRow::refused || (rows_.short_row == ShortRow::gaps && (!triples || pads())))
      throw ReadError(path_, line,
                      fmt::format("{} cells, expected {} as in the header; a cell is lost", row.cells, width()));
    if (short_line_ == 0) short_line_ = line;
    if (rows_.short_row == ShortRow::ended) require_that_none_follows(i);
    return true;
  }

  /// Returns true if the file writes separators of empty cells at the end of a row: then no row is
  /// cut off by missing cells.
  [[nodiscard]] bool pads() const {
    return std::ranges::any_of(
        scans_, [&](const RowScan& row) { return row.cells >= width() && row.filled < width() && !row.blank; });
  }

  /// A channel that has ended does not begin again: throws if a later row has more cells than this one.
  void require_that_none_follows(std::size_t i) {
    if (i < checked_end_) return;
    for (std::size_t k = scans_.size(); k-- > i + 1;) {
      if (scans_[k].cells > scans_[i].cells)
        throw ReadError(
            path_, rows_.first + i + 1,
            fmt::format("{} cells, expected {} as in the header: a cell is lost, since line {} below has {}",
                        scans_[i].cells, width(), rows_.first + k + 1, scans_[k].cells));
    }
    // Rows below need a check of their own only where they are narrower still.
    checked_end_ = i + 1;
    while (checked_end_ < scans_.size() && scans_[checked_end_].cells >= scans_[i].cells) ++checked_end_;
  }

  [[noreturn]] void refuse_cell(std::size_t i) const {
    const auto cells = cells_of(line_of(i), rows_.separator);
    for (std::size_t c = 0; c < std::min(cells.size(), uses_.size()); ++c) {
      double ignored = 0.0;
      if (uses_[c].is_number() && read_cell(cells[c], rows_.separator, ignored) == CellKind::wrong)
        throw ReadError(
            path_, rows_.first + i + 1,
            fmt::format("column {} ('{}'): expected a number, found '{}'{}", c + 1, rows_.names[c], cells[c],
                        has_thousands(cells[c]) ? "; export without a separator of thousands" : ""));
    }
    throw ReadError(path_, rows_.first + i + 1, "expected a number in each cell");
  }

  void take_remarks(std::size_t i, std::size_t row) {
    const auto cells = cells_of(line_of(i), rows_.separator);
    for (const std::size_t c : rows_.texts) {
      if (c < cells.size() && !cells[c].empty()) numbers_.remarks.push_back({row, c, cells[c]});
    }
  }

  /// Throws for a point beside decimal commas: it may mark thousands or come from another program.
  void refuse_points() const {
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      if (line_of(i).find('.') == std::string_view::npos) continue;
      const auto cells = cells_of(line_of(i), rows_.separator);
      for (std::size_t c = 0; c < std::min(cells.size(), uses_.size()); ++c) {
        if (uses_[c].is_number() && cells[c].find('.') != std::string::npos && parse_number(cells[c]))
          throw ReadError(
              path_, rows_.first + i + 1,
              fmt::format(
                  "'{}' has a decimal point, while line {} has decimal commas; expected one of them in the whole table",
                  cells[c], comma_line_));
      }
    }
  }

  /// Adds a day where a time of the day falls by more than half a day.
  void pass_midnight() {
    constexpr double kDay_s = 86400.0;
    for (auto time : numbers_.clock.colwise()) {
      double added = 0.0, before = kNan;
      for (Eigen::Index i = 0; i < time.size(); ++i) {
        if (time[i] < before - 0.5 * kDay_s) added += kDay_s;
        before = time[i];
        time[i] += added;
      }
    }
  }

  void state_what_was_mended() {
    if (thousands_line_ > 0 && comma_line_ == 0)
      throw ReadError(path_, thousands_line_,
                      "a comma inside the quotes may stand before decimals or part thousands; export with decimal "
                      "points and without a separator of thousands");
    if (header_line_ > 0) note(header_line_, "the header stands again between the rows; passed over");
    if (comma_line_ > 0) {
      refuse_points();
      note(comma_line_, "comma decimals read as decimal points");
    }
    if (day_line_ > 0) {
      note(day_line_, "times of the day are read in seconds");
      numbers_.day_times = true;
      pass_midnight();
    }
    if (blank_line_ > 0)
      note(first_blank_, fmt::format("{} between rows of numbers passed over",
                                     blank_line_ == 1 ? "a blank line" : fmt::format("{} blank lines", blank_line_)));
    if (short_line_ > 0)
      note(short_line_, rows_.short_row == ShortRow::gaps
                            ? "a row ends early; the markers behind its end are taken as missing"
                            : "a row ends early; the channels behind its end have ended");
    if (gap_line_ > 0 && rows_.state_gaps) note(gap_line_, "a value is missing or no number; kept as a gap");
    compare_count(rows_.rows_said, numbers_.lines.size(), "rows", numbers_.repairs);
  }

  const TableText& text_;
  const TableRows& rows_;
  const std::filesystem::path& path_;
  std::vector<ColumnUse> uses_;
  std::vector<RowScan> scans_;
  TableNumbers numbers_;
  std::size_t end_ = 0, checked_end_ = 0;
  std::size_t comma_line_ = 0, day_line_ = 0, gap_line_ = 0, short_line_ = 0, first_blank_ = 0;
  std::size_t blank_line_ = 0, header_line_ = 0, thousands_line_ = 0;
};

}  // namespace

TableNumbers read_rows(const TableText& text, const TableRows& rows, const std::filesystem::path& path) {
  return RowReader(text, rows, path).read();
}

}  // namespace myoid::recording
