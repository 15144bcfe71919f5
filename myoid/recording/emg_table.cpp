#include "myoid/recording/emg_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/recording/emg_table_layout.h"
#include "myoid/recording/vendor_table.h"

namespace myoid::recording {
namespace {

using emg_table::cells_of;
using emg_table::Label;
using emg_table::Layout;
using emg_table::lower;
using Lines = std::vector<std::string_view>;

struct Column {
  std::size_t index = 0;
  Label label;
  std::optional<std::size_t> clock;  ///< The column of its times; none: by the stated rate.
  std::vector<double> time, values;
};

/// Same clock: as many samples, give or take some at the end, at the same times.
bool same_clock(const Column& a, const Column& b) {
  const std::size_t n = std::min(a.time.size(), b.time.size());
  if (n < 2) return false;
  const double dt = (a.time[n - 1] - a.time[0]) / static_cast<double>(n - 1);
  return std::abs(a.time[0] - b.time[0]) < 0.1 * dt &&
         std::abs(a.time[n - 1] - b.time[n - 1]) < 0.1 * dt;
}

/// The channel whose clock counts: the first in volts, else the first called EMG, else the first.
const Column& leader_of(const std::vector<Column>& columns) {
  const auto in_volts = [](const Column& c) {
    return c.label.unit && c.label.unit->unit == Unit::volt;
  };
  const auto called_emg = [](const Column& c) {
    return lower(c.label.name).find("emg") != std::string::npos;
  };
  auto leader = std::find_if(columns.begin(), columns.end(), in_volts);
  if (leader == columns.end()) leader = std::find_if(columns.begin(), columns.end(), called_emg);
  return leader == columns.end() ? columns.front() : *leader;
}

/// A table with its layout, column by column, then as channels of one clock.
class TableReader {
 public:
  TableReader(const Lines& lines, const Layout& layout, const std::filesystem::path& path)
      : lines_(lines), layout_(layout), path_(path) {}

  CsvSeries read(std::string_view text, std::size_t widest) {
    sort_columns();
    read_rows(text, widest);
    join();
    return std::move(series_);
  }

 private:
  void note(std::size_t line, std::string message) {
    series_.repairs.push_back({line, std::move(message)});
  }

  /// What each column is.
  void sort_columns() {
    std::vector<std::size_t> times;
    std::vector<std::string> counters;
    const std::vector<bool> is_time = emg_table::time_columns_of(layout_.labels);
    for (std::size_t c = 0; c < layout_.labels.size(); ++c) {
      const Label& label = layout_.labels[c];
      if (is_time[c]) {
        times.push_back(c);
      } else if (emg_table::is_counter(label.name)) {
        counters.push_back(label.name);
      } else {
        Column column{c, label, times.empty() ? std::nullopt : std::optional(times.back()), {}, {}};
        if (label.name.empty()) {
          column.label.name = fmt::format("column_{}", c + 1);
          ++unnamed_;
        }
        columns_.push_back(std::move(column));
      }
    }
    if (!counters.empty())
      note(layout_.names_row + 1,
           fmt::format("columns of numbers of frames or samples are left out: {}",
                       fmt::join(counters, ", ")));
    if (times.empty() && !layout_.rate_hz) {
      throw ReadError(
          path_, layout_.names_row + 1,
          "neither a time column nor a sampling rate is in the file; add a column "
          "named 'time' in seconds, or a line 'Sampling rate: 2000 Hz' above the names");
    }
    if (times.empty())
      note(0, fmt::format("no time column; the rate of {} Hz stated in the header is taken",
                          *layout_.rate_hz));
    for (Column& column : columns_) {
      if (!times.empty() && (times.size() == 1 || !column.clock)) column.clock = times[0];
    }
    time_columns_ = times.size();
  }

  double number(const std::string& cell, std::size_t line) {
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    if (const auto value = parse_number(cell)) return *value;
    const auto value = emg_table::cell_number(cell, layout_.separator);
    if (!value)
      throw ReadError(path_, line + 1, fmt::format("expected a number, found '{}'", cell));
    if (comma_line_ == 0) comma_line_ = line + 1;
    return *value;
  }

  /// Seconds for each number of a column's clock.
  [[nodiscard]] double to_seconds(const Column& column) const {
    if (!column.clock) return 1.0;
    const Label& label = layout_.labels[*column.clock];
    if (label.unit) return label.unit->to_si;
    return lower(label.name) == "time_ms" ? 1e-3 : 1.0;
  }

  void read_rows(std::string_view text, std::size_t widest) {
    std::size_t row = 0;
    std::vector<double> numbers;
    for (std::size_t n = layout_.first_row; n < lines_.size(); ++n) {
      if (trim(lines_[n]).empty()) continue;
      const auto cells = cells_of(lines_[n], layout_.separator);
      const bool last = n + 1 == lines_.size();
      if (last && !ends_with_line(text) && row > 0) {
        note(n + 1, std::string(kLastRowLeftOut));
        break;
      }
      if (last && cells.size() < widest) {
        note(n + 1,
             fmt::format("the last row has {} of {} cells and is left out", cells.size(), widest));
        break;
      }
      numbers.assign(layout_.labels.size(), std::numeric_limits<double>::quiet_NaN());
      for (std::size_t c = 0; c < std::min(cells.size(), numbers.size()); ++c) {
        if (!emg_table::is_counter(layout_.labels[c].name)) numbers[c] = number(cells[c], n);
      }
      for (Column& column : columns_) {
        const double time = column.clock ? to_seconds(column) * numbers[*column.clock]
                                         : static_cast<double>(row) / *layout_.rate_hz;
        if (!std::isfinite(time)) continue;  // this channel has ended
        if (!column.time.empty() && time <= column.time.back())
          throw ReadError(path_, n + 1,
                          fmt::format("the time of '{}' does not increase: {} s after {} s",
                                      column.label.name, time, column.time.back()));
        column.time.push_back(time);
        column.values.push_back(numbers[column.index]);
      }
      ++row;
    }
    for (Column& column : columns_) {
      while (!column.values.empty() && !std::isfinite(column.values.back())) {
        column.values.pop_back();
        column.time.pop_back();
      }
    }
    if (comma_line_ > 0) note(comma_line_, "comma decimals read as decimal points");
    std::erase_if(columns_, [](const Column& c) { return c.values.size() < 2; });
    if (columns_.empty())
      throw ReadError(path_, 0, "there are no columns of numbers beside the time");
  }

  /// The channels of one clock; those of another are left out.
  [[nodiscard]] std::vector<const Column*> one_clock(const Column& leader) {
    std::vector<std::string> others;
    std::vector<const Column*> kept;
    for (const Column& column : columns_) {
      if (same_clock(column, leader)) {
        kept.push_back(&column);
      } else {
        others.push_back(column.label.name);
      }
    }
    if (!others.empty()) {
      const std::size_t all = others.size();
      others.resize(std::min<std::size_t>(all, 8));
      note(0, fmt::format("{} channels with another clock than '{}' are left out: {}{}", all,
                          leader.label.name, fmt::join(others, ", "), all > 8 ? ", ..." : ""));
    }
    if (time_columns_ > 1)
      note(layout_.names_row + 1,
           fmt::format("{} time columns; the {} channels of one clock are joined", time_columns_,
                       kept.size()));
    return kept;
  }

  void join() {
    const Column& leader = leader_of(columns_);
    const std::vector<const Column*> kept = one_clock(leader);
    std::size_t samples = leader.time.size();
    std::size_t longest = samples;
    for (const Column* column : kept) {
      samples = std::min(samples, column->time.size());
      longest = std::max(longest, column->time.size());
    }
    if (longest > samples)
      note(0, fmt::format("the channels differ in length; all are cut to {} samples", samples));
    if (unnamed_ > 0) note(layout_.names_row + 1, fmt::format("{} columns have no name", unnamed_));

    std::vector<Channel> channels;
    std::set<std::string> seen;
    const auto count = static_cast<Eigen::Index>(samples);
    Eigen::MatrixXd values(count, static_cast<Eigen::Index>(kept.size()));
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const Label& label = kept[k]->label;
      std::string name = label.name;
      for (int i = 2; !seen.insert(name).second; ++i) {
        const std::string other = fmt::format("{}_{}", label.name, i);
        note(layout_.names_row + 1,
             fmt::format("two columns are named '{}'; the later one is '{}' here", label.name,
                         other));
        name = other;
      }
      channels.push_back({name, label.unit ? label.unit->unit : Unit::dimensionless});
      series_.has_unit.push_back(label.unit.has_value());
      values.col(static_cast<Eigen::Index>(k)) =
          (label.unit ? label.unit->to_si : 1.0) *
          Eigen::Map<const Eigen::VectorXd>(kept[k]->values.data(), count);
    }
    series_.data = TimeSeries(Eigen::Map<const Eigen::VectorXd>(leader.time.data(), count),
                              std::move(channels), std::move(values));
  }

  const Lines& lines_;
  const Layout& layout_;
  const std::filesystem::path& path_;
  CsvSeries series_;
  std::vector<Column> columns_;
  std::size_t time_columns_ = 0;
  std::size_t unnamed_ = 0;
  std::size_t comma_line_ = 0;
};

}  // namespace

CsvSeries parse_emg_table(std::string_view text, const std::filesystem::path& path) {
  if (const PlainTable plain = plain_vendor_table(text); !plain.text.empty()) {
    CsvSeries series = parse_emg_table(plain.text, path);
    series.repairs.insert(series.repairs.begin(), plain.repairs.begin(), plain.repairs.end());
    return series;
  }
  const Lines lines = split_lines(text);
  std::optional<Layout> layout;
  std::size_t widest = 1;
  for (const char separator : {'\t', ';', ','}) {
    auto found = emg_table::find_table(lines, separator);
    if (!found) continue;
    const std::size_t width = cells_of(lines[found->first_row], separator).size();
    if (width > widest) {
      widest = width;
      layout = std::move(found);
    }
  }
  if (layout && emg_table::is_numbers(cells_of(lines[layout->names_row], layout->separator),
                                      layout->separator)) {
    throw ReadError(
        path, layout->names_row + 1,
        "the table begins with numbers; expected a row of names above them, and a column "
        "'time' or a line 'Sampling rate: 2000 Hz'");
  }
  if (!layout || emg_table::is_plain(lines, *layout)) return parse_csv_series(text, path);
  return TableReader(lines, *layout, path).read(text, widest);
}

CsvSeries read_emg_table(const std::filesystem::path& path) {
  return parse_emg_table(read_text_file(path), path);
}

}  // namespace myoid::recording
