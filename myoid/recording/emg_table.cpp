#include "myoid/recording/emg_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/recording/c3d_file.h"
#include "myoid/recording/vendor_table.h"

namespace myoid::recording {
namespace {

std::string lower(std::string_view text) {
  std::string word(text);
  for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return word;
}

std::string_view unquoted(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = cell.substr(1, cell.size() - 2);
  return trim(cell);
}

/// Cells of a row; separators inside quotes do not count.
std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i == line.size() || (line[i] == separator && !quoted)) {
      cells.push_back(to_utf8(unquoted(line.substr(begin, i - begin))));
      begin = i + 1;
    }
  }
  return cells;
}

std::optional<double> cell_number(std::string_view cell, char separator) {
  if (const auto value = parse_number(cell)) return value;
  return separator == ',' ? std::nullopt : parse_comma_number(cell);
}

/// A row of nothing but numbers and empty cells, at least one of the former.
bool is_numbers(const std::vector<std::string>& cells, char separator) {
  std::size_t numbers = 0;
  for (const std::string& cell : cells) {
    if (cell.empty()) continue;
    if (!cell_number(cell, separator)) return false;
    ++numbers;
  }
  return numbers > 0;
}

struct Label {
  std::string name;
  std::optional<ScaledUnit> unit;
};

/// "name [mV]", "name (mV)", "name, mV", "[mV]".
Label take_apart(const std::string& text) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t begin = text.rfind(open);
    const std::size_t end = text.rfind(close);
    if (begin == std::string::npos || end == std::string::npos || end < begin) continue;
    const auto inside = std::string_view(text).substr(begin + 1, end - begin - 1);
    const auto unit = lower(inside) == "sec" || lower(inside) == "seconds" ? parse_unit("s")
                                                                           : parse_c3d_unit(inside);
    if (unit) return {std::string(trim(text.substr(0, begin))), unit};
  }
  if (const std::size_t comma = text.rfind(','); comma != std::string::npos && comma > 0) {
    if (const auto unit = parse_c3d_unit(trim(std::string_view(text).substr(comma + 1))))
      return {std::string(trim(std::string_view(text).substr(0, comma))), unit};
  }
  return {text, std::nullopt};
}

bool is_time(const Label& label) {
  std::string name = lower(label.name);
  if (const std::size_t point = name.find('.'); point != std::string::npos && point > 0)
    name.resize(point);  // "X[s].1" of programs that make names unique
  static const std::set<std::string> kWords{"time",    "t",         "times",       "time_s",
                                            "time_ms", "timestamp", "time stamp",  "zeit",
                                            "temps",   "tiempo",    "time series", "abs time"};
  if (kWords.contains(name)) return true;
  // "EMG 1 Time Series (s)": a time column for each channel.
  if (name.ends_with("time series") && label.unit && label.unit->unit == Unit::second) return true;
  return (name == "x" || name.starts_with("x[s]")) &&
         (!label.unit || label.unit->unit == Unit::second);
}

/// Columns of times. A second one called just "t" or "T" is a channel (a trigger, a torque), unless
/// the first has the same name.
std::vector<bool> time_columns_of(const std::vector<Label>& labels) {
  std::vector<bool> result;
  std::optional<std::string> first;
  for (const Label& label : labels) {
    const bool time =
        is_time(label) && (!first || *first == label.name || lower(label.name) != "t");
    if (time && !first) first = label.name;
    result.push_back(time);
  }
  return result;
}

bool is_counter(const std::string& name) {
  static const std::set<std::string> kWords{
      "frame",      "frames",        "frame#",  "sample", "samples", "sub frame", "subframe",
      "sub frame#", "index",         "#",       "no",     "no.",     "nr",        "marker",
      "sample #",   "sample number", "activity"};
  return kWords.contains(lower(name));
}

/// The number behind a word that means a sampling rate, anywhere in a line.
std::optional<double> rate_in(std::string_view line) {
  const std::string text = lower(line);
  for (const char* word : {"sampling frequency", "sampling rate", "sample rate", "samplerate",
                           "sample frequency", "samplingrate", "frequency", "rate", "fs"}) {
    const std::size_t at = text.find(word);
    if (at == std::string::npos) continue;
    std::size_t i = at + std::string_view(word).size();
    while (i < text.size() && (text[i] < '0' || text[i] > '9')) {
      if (text[i] >= 'a' && text[i] <= 'z' && text.compare(i, 2, "hz") != 0) break;
      ++i;
    }
    std::size_t end = i;
    while (end < text.size() && ((text[end] >= '0' && text[end] <= '9') || text[end] == '.')) ++end;
    const auto value = parse_number(std::string_view(text).substr(i, end - i));
    if (value && *value >= 1.0 && *value <= 1e6) return value;
  }
  return std::nullopt;
}

/// "Label: EMG 1 Sampling frequency: 1925.926 Unit: V Domain: Time": name and unit.
std::optional<Label> label_line(std::string_view line) {
  const std::string text = lower(line);
  const std::size_t begin = text.find("label:");
  const std::size_t unit = text.find("unit:");
  if (begin == std::string::npos || unit == std::string::npos) return std::nullopt;
  std::size_t end = std::min(text.find("sampling", begin), unit);
  Label label;
  label.name = std::string(trim(line.substr(begin + 6, end - begin - 6)));
  const auto words = split_words(line.substr(unit + 5));
  if (!words.empty()) label.unit = parse_c3d_unit(words[0]);
  return label;
}

struct Layout {
  char separator = ',';
  std::size_t first_row = 0;  ///< Of numbers.
  std::size_t names_row = 0;
  std::vector<Label> labels;
  std::optional<double> rate_hz;
};

std::optional<Layout> find_table(const std::vector<std::string_view>& lines, char separator) {
  Layout layout;
  layout.separator = separator;
  const auto cells = [&](std::size_t n) { return cells_of(lines[n], separator); };
  const std::size_t most = std::min<std::size_t>(lines.size(), 1000);
  for (std::size_t n = 1; n < most; ++n) {
    const auto row = cells(n);
    if (row.size() < 2 || !is_numbers(row, separator)) continue;
    // Numbers below each other: the next row that is not empty is as wide and of numbers too.
    std::size_t next = n + 1;
    while (next < lines.size() && trim(lines[next]).empty()) ++next;
    if (next < lines.size() &&
        (cells(next).size() + 1 < row.size() || !is_numbers(cells(next), separator)))
      continue;
    layout.first_row = n;
    break;
  }
  if (layout.first_row == 0) return std::nullopt;
  const std::size_t width = cells(layout.first_row).size();
  std::size_t above = layout.first_row;
  const auto previous = [&]() -> bool {
    while (above > 0 && trim(lines[above - 1]).empty()) --above;
    if (above == 0) return false;
    --above;
    return true;
  };
  if (!previous()) return std::nullopt;
  auto names = cells(above);
  // A row of rates, "2148.148 Hz", between names and numbers says nothing that the times do not.
  const bool rates = std::all_of(names.begin(), names.end(), [](const std::string& cell) {
    return cell.empty() || (cell.ends_with("Hz") &&
                            parse_number(trim(std::string_view(cell).substr(0, cell.size() - 2))));
  });
  if (rates && previous()) names = cells(above);
  // A row of units between names and numbers.
  std::vector<std::string> units;
  bool all_units = true;
  std::size_t filled = 0;
  for (const std::string& cell : names) {
    if (cell.empty()) continue;
    ++filled;
    const Label label = take_apart(cell);
    all_units = all_units &&
                (parse_c3d_unit(cell) || parse_unit(cell) || (label.name.empty() && label.unit));
  }
  if (all_units && filled > 0 && previous()) {
    units = std::move(names);
    names = cells(above);
  }
  layout.names_row = above;
  names.resize(std::max(names.size(), width));
  for (std::size_t c = 0; c < names.size(); ++c) {
    Label label = take_apart(names[c]);
    if (!label.unit && c < units.size() && !units[c].empty()) {
      label.unit = take_apart(units[c]).unit;
      if (!label.unit) label.unit = parse_c3d_unit(units[c]);
      if (!label.unit) label.unit = parse_unit(units[c]);
    }
    layout.labels.push_back(std::move(label));
  }
  std::map<std::string, std::optional<ScaledUnit>> known;
  for (std::size_t n = 0; n < layout.names_row; ++n) {
    if (const auto label = label_line(lines[n])) {
      known[label->name] = label->unit;
    } else if (!layout.rate_hz) {
      layout.rate_hz = rate_in(lines[n]);
    }
  }
  for (Label& label : layout.labels) {
    if (const auto it = known.find(label.name); it != known.end() && !label.unit)
      label.unit = it->second;
  }
  return layout;
}

/// Plain: the first line that is no remark is the header, with one time column and no other line of
/// text below.
bool is_plain(const std::vector<std::string_view>& lines, const Layout& layout) {
  std::size_t n = 0;
  while (n < lines.size() && (trim(lines[n]).empty() || trim(lines[n]).starts_with('#'))) ++n;
  if (n != layout.names_row) return false;
  std::size_t times = 0;
  const std::vector<bool> time = time_columns_of(layout.labels);
  for (std::size_t c = 0; c < layout.labels.size(); ++c) {
    const Label& label = layout.labels[c];
    if (is_counter(label.name) || label.name.find(',') != std::string::npos) return false;
    const std::string name = lower(label.name);
    if (time[c]) {
      if (name != "time" && name != "t" && name != "times" && name != "time_s" && name != "time_ms")
        return false;
      ++times;
    }
  }
  return times == 1;
}

struct Column {
  std::size_t index;
  Label label;
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

}  // namespace

CsvSeries parse_emg_table(std::string_view text, const std::filesystem::path& path) {
  if (const PlainTable plain = plain_vendor_table(text); !plain.text.empty()) {
    CsvSeries series = parse_emg_table(plain.text, path);
    series.repairs.insert(series.repairs.begin(), plain.repairs.begin(), plain.repairs.end());
    return series;
  }
  const auto lines = split_lines(text);
  std::optional<Layout> layout;
  std::size_t widest = 1;
  for (const char separator : {'\t', ';', ','}) {
    auto found = find_table(lines, separator);
    if (!found) continue;
    const std::size_t width = cells_of(lines[found->first_row], separator).size();
    if (width > widest) {
      widest = width;
      layout = std::move(found);
    }
  }
  if (layout &&
      is_numbers(cells_of(lines[layout->names_row], layout->separator), layout->separator)) {
    throw ReadError(
        path, layout->names_row + 1,
        "the table begins with numbers; expected a row of names above them, and a column "
        "'time' or a line 'Sampling rate: 2000 Hz'");
  }
  if (!layout || is_plain(lines, *layout)) return parse_csv_series(text, path);

  CsvSeries series;
  const auto note = [&](std::size_t line, std::string message) {
    series.repairs.push_back({line, std::move(message)});
  };
  // What each column is.
  std::vector<std::size_t> time_columns;
  std::vector<std::string> counters;
  std::vector<Column> columns;
  std::vector<std::optional<std::size_t>> clock;
  std::size_t unnamed = 0;
  const std::vector<bool> is_time_column = time_columns_of(layout->labels);
  for (std::size_t c = 0; c < layout->labels.size(); ++c) {
    const Label& label = layout->labels[c];
    if (is_time_column[c]) {
      time_columns.push_back(c);
    } else if (is_counter(label.name)) {
      counters.push_back(label.name);
    } else {
      Column column{c, label, {}, {}};
      if (label.name.empty()) {
        column.label.name = fmt::format("column_{}", c + 1);
        ++unnamed;
      }
      clock.push_back(time_columns.empty() ? std::nullopt : std::optional(time_columns.back()));
      columns.push_back(std::move(column));
    }
  }
  if (!counters.empty())
    note(layout->names_row + 1,
         fmt::format("columns of numbers of frames or samples are left out: {}",
                     fmt::join(counters, ", ")));
  if (time_columns.empty() && !layout->rate_hz) {
    throw ReadError(path, layout->names_row + 1,
                    "neither a time column nor a sampling rate is in the file; add a column named "
                    "'time' in seconds, or a line 'Sampling rate: 2000 Hz' above the names");
  }
  if (time_columns.empty())
    note(0, fmt::format("no time column; the rate of {} Hz stated in the header is taken",
                        *layout->rate_hz));
  for (auto& t : clock) {
    if (!time_columns.empty() && (time_columns.size() == 1 || !t)) t = time_columns[0];
  }

  // The numbers.
  std::size_t comma_line = 0;
  const auto number = [&](const std::string& cell, std::size_t n) {
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    if (const auto value = parse_number(cell)) return *value;
    const auto value = cell_number(cell, layout->separator);
    if (!value) throw ReadError(path, n + 1, fmt::format("expected a number, found '{}'", cell));
    if (comma_line == 0) comma_line = n + 1;
    return *value;
  };
  std::size_t row = 0;
  std::vector<double> cells_row;
  for (std::size_t n = layout->first_row; n < lines.size(); ++n) {
    if (trim(lines[n]).empty()) continue;
    const auto cells = cells_of(lines[n], layout->separator);
    if (n + 1 == lines.size() && !ends_with_line(text) && row > 0) {
      note(n + 1, std::string(kLastRowLeftOut));
      break;
    }
    if (n + 1 == lines.size() && cells.size() < widest) {
      note(n + 1,
           fmt::format("the last row has {} of {} cells and is left out", cells.size(), widest));
      break;
    }
    cells_row.assign(layout->labels.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t c = 0; c < std::min(cells.size(), cells_row.size()); ++c) {
      const bool used = !is_counter(layout->labels[c].name);
      if (used) cells_row[c] = number(cells[c], n);
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double to_s = clock[k] && layout->labels[*clock[k]].unit
                              ? layout->labels[*clock[k]].unit->to_si
                          : clock[k] && lower(layout->labels[*clock[k]].name) == "time_ms" ? 1e-3
                                                                                           : 1.0;
      const double time =
          clock[k] ? to_s * cells_row[*clock[k]] : static_cast<double>(row) / *layout->rate_hz;
      if (!std::isfinite(time)) continue;  // this channel has ended
      if (!columns[k].time.empty() && time <= columns[k].time.back())
        throw ReadError(path, n + 1,
                        fmt::format("the time of '{}' does not increase: {} s after {} s",
                                    columns[k].label.name, time, columns[k].time.back()));
      columns[k].time.push_back(time);
      columns[k].values.push_back(cells_row[columns[k].index]);
    }
    ++row;
  }
  for (Column& column : columns) {
    while (!column.values.empty() && !std::isfinite(column.values.back())) {
      column.values.pop_back();
      column.time.pop_back();
    }
  }
  if (comma_line > 0) note(comma_line, "comma decimals read as decimal points");
  std::erase_if(columns, [](const Column& c) { return c.values.size() < 2; });
  if (columns.empty()) throw ReadError(path, 0, "there are no columns of numbers beside the time");

  // One clock: that of the first channel in volts, else of one called EMG, else of the first.
  const auto in_volts = [](const Column& c) {
    return c.label.unit && c.label.unit->unit == Unit::volt;
  };
  const auto called_emg = [](const Column& c) {
    return lower(c.label.name).find("emg") != std::string::npos;
  };
  auto leader = std::find_if(columns.begin(), columns.end(), in_volts);
  if (leader == columns.end()) leader = std::find_if(columns.begin(), columns.end(), called_emg);
  if (leader == columns.end()) leader = columns.begin();
  const Column reference = *leader;
  std::vector<std::string> other_clock;
  std::vector<const Column*> kept;
  std::size_t samples = reference.time.size();
  std::size_t longest = samples;
  for (const Column& column : columns) {
    if (!same_clock(column, reference)) {
      other_clock.push_back(column.label.name);
      continue;
    }
    kept.push_back(&column);
    samples = std::min(samples, column.time.size());
    longest = std::max(longest, column.time.size());
  }
  if (!other_clock.empty()) {
    const std::size_t all = other_clock.size();
    other_clock.resize(std::min<std::size_t>(all, 8));
    note(0,
         fmt::format("{} channels with another clock than '{}' are left out: {}{}", all,
                     reference.label.name, fmt::join(other_clock, ", "), all > 8 ? ", ..." : ""));
  }
  if (time_columns.size() > 1)
    note(layout->names_row + 1,
         fmt::format("{} time columns; the {} channels of one clock are joined",
                     time_columns.size(), kept.size()));
  if (longest > samples)
    note(0, fmt::format("the channels differ in length; all are cut to {} samples", samples));
  if (unnamed > 0) note(layout->names_row + 1, fmt::format("{} columns have no name", unnamed));

  std::vector<Channel> channels;
  std::set<std::string> seen;
  const auto count = static_cast<Eigen::Index>(samples);
  Eigen::MatrixXd values(count, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Label& label = kept[k]->label;
    std::string name = label.name;
    for (int i = 2; !seen.insert(name).second; ++i) {
      const std::string other = fmt::format("{}_{}", label.name, i);
      note(
          layout->names_row + 1,
          fmt::format("two columns are named '{}'; the later one is '{}' here", label.name, other));
      name = other;
    }
    channels.push_back({name, label.unit ? label.unit->unit : Unit::dimensionless});
    series.has_unit.push_back(label.unit.has_value());
    values.col(static_cast<Eigen::Index>(k)) =
        (label.unit ? label.unit->to_si : 1.0) *
        Eigen::Map<const Eigen::VectorXd>(kept[k]->values.data(), count);
  }
  series.data = TimeSeries(Eigen::Map<const Eigen::VectorXd>(reference.time.data(), count),
                           std::move(channels), std::move(values));
  return series;
}

CsvSeries read_emg_table(const std::filesystem::path& path) {
  return parse_emg_table(read_text_file(path), path);
}

}  // namespace myoid::recording
