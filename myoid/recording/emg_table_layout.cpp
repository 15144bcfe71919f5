#include "myoid/recording/emg_table_layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/c3d_file.h"
#include "myoid/recording/text_file.h"

namespace myoid::recording::emg_table {

std::string lower(std::string_view text) {
  std::string word(text);
  for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return word;
}

namespace {

std::string_view unquoted(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = cell.substr(1, cell.size() - 2);
  return trim(cell);
}

}  // namespace

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

bool is_numbers(const std::vector<std::string>& cells, char separator) {
  std::size_t numbers = 0;
  for (const std::string& cell : cells) {
    if (cell.empty()) continue;
    if (!cell_number(cell, separator)) return false;
    ++numbers;
  }
  return numbers > 0;
}

namespace {

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

}  // namespace

namespace {

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

}  // namespace

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

namespace {

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

}  // namespace

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

}  // namespace myoid::recording::emg_table
