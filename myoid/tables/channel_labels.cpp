#include "myoid/tables/channel_labels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/files/file_words.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

std::optional<ScaledUnit> unit_of(std::string_view word) {
  word = trim(word);
  if (lower(word) == "sec" || lower(word) == "seconds") return parse_unit("s");
  if (const auto unit = parse_file_unit(word)) return unit;
  return parse_unit(word);
}

bool is_time(const TableColumn& column) {
  std::string name = lower(column.name);
  if (const std::size_t point = name.find('.'); point != std::string::npos && point > 0)
    name.resize(point);  // "X[s].1" of programs that make names unique
  static const std::set<std::string> kWords{"time",       "t",    "times", "time_s", "time_ms",     "timestamp",
                                            "time stamp", "zeit", "temps", "tiempo", "time series", "abs time"};
  if (kWords.contains(name)) return true;
  const bool seconds = column.unit && column.unit->unit == Unit::second;
  // "EMG 1 Time Series (s)": a time column for each channel.
  if (name.ends_with("time series") && seconds) return true;
  return (name == "x" || name.starts_with("x[s]")) && (!column.unit || seconds);
}

Kind kind_by_name(const std::string& label) {
  static const std::map<Kind, std::set<std::string>> kWords{
      {Kind::frame,
       {"frame", "frames", "frame#", "sample", "samples", "sample #", "sample number", "index", "#", "no", "no.",
        "nr"}},
      {Kind::sub_frame, {"sub frame", "subframe", "sub frame#"}},
      {Kind::remark, {"marker", "markers", "activity", "event", "events", "comment", "comments", "remark", "note"}}};
  const std::string word = lower(label);
  for (const auto& [kind, words] : kWords)
    if (words.contains(word)) return kind;
  return Kind::channel;
}

/// Returns the letters from `at` on.
std::string word_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && text[end] >= 'a' && text[end] <= 'z') ++end;
  return std::string(text.substr(at, end - at));
}

}  // namespace

std::optional<ScaledUnit> unit_in_cell(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() > 2 && ((cell.front() == '[' && cell.back() == ']') || (cell.front() == '(' && cell.back() == ')')))
    cell = cell.substr(1, cell.size() - 2);
  return unit_of(cell);
}

std::optional<double> rate_in_cell(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() < 3 || !equal_ignoring_case(cell.substr(cell.size() - 2), "hz")) return std::nullopt;
  cell.remove_suffix(2);
  const bool kilo = cell.back() == 'k' || cell.back() == 'K';
  if (kilo) cell.remove_suffix(1);
  const auto number = parse_number(trim(cell));
  if (!number) return std::nullopt;
  const double rate = kilo ? 1000.0 * *number : *number;
  return rate > 0.0 && rate <= 1e6 ? std::optional(rate) : std::nullopt;
}

TableColumn take_label_apart(const std::string& text) {
  TableColumn column;
  column.name = text;
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t begin = column.name.rfind(open);
    const std::size_t end = column.name.rfind(close);
    if (begin == std::string::npos || end == std::string::npos || end < begin) continue;
    const std::string inside = column.name.substr(begin + 1, end - begin - 1);
    const auto rate = rate_in_cell(inside);
    const auto unit = rate ? std::nullopt : unit_of(inside);
    if (!rate && !unit) continue;
    if (rate) column.rate_hz = packet_rate(*rate);
    if (unit) column.unit = unit;
    column.name = std::string(trim(column.name.substr(0, begin)));
  }
  if (column.unit || column.rate_hz > 0.0) return column;
  if (const std::size_t comma = text.rfind(','); comma != std::string::npos && comma > 0) {
    if (const auto unit = unit_of(std::string_view(text).substr(comma + 1))) {
      column.name = std::string(trim(text.substr(0, comma)));
      column.unit = unit;
    }
  }
  return column;
}

std::optional<StatedRate> rate_in_line(std::string_view line) {
  const std::string text = lower(line);
  for (const char* word : {"sampling frequency", "sampling rate", "sample rate", "samplerate", "sample frequency",
                           "samplingrate", "frequency", "rate", "fs"}) {
    const std::size_t at = text.find(word);
    if (at == std::string::npos) continue;
    std::size_t i = at + std::string_view(word).size();
    std::string unit;
    while (i < text.size() && (text[i] < '0' || text[i] > '9')) {
      const std::string before = word_at(text, i);
      if (!before.empty() && before != "hz" && before != "khz") break;
      if (!before.empty()) unit = before;
      i += std::max<std::size_t>(1, before.size());
    }
    std::size_t end = i;
    while (end < text.size() && ((text[end] >= '0' && text[end] <= '9') || text[end] == '.')) ++end;
    const auto number = parse_number(std::string_view(text).substr(i, end - i));
    while (end < text.size() && std::string_view(" \t;[(").find(text[end]) != std::string_view::npos) ++end;
    if (const std::string behind = word_at(text, end); !behind.empty()) unit = behind;
    if (!number) continue;
    if (unit == "mhz" || unit == "ghz" || unit == "ms" || unit == "us" || unit == "ns")
      return StatedRate{.hz = 0.0, .other_unit = unit};
    const double rate = unit == "khz" ? 1000.0 * *number : *number;
    if (rate >= 1.0 && rate <= 1e6) return StatedRate{.hz = rate, .other_unit = {}};
  }
  return std::nullopt;
}

void set_kinds(std::vector<TableColumn>& columns) {
  std::optional<std::string> first;
  for (TableColumn& column : columns) {
    if (is_time(column) && (!first || *first == column.name || lower(column.name) != "t")) {
      column.kind = Kind::time;
      if (!first) first = column.name;
      if (!column.unit && lower(column.name) == "time_ms") column.unit = parse_unit("ms");
    } else {
      column.kind = kind_by_name(column.name);
    }
  }
}

double packet_rate(double rate_hz) {
  constexpr double kPacket_s = 0.027;
  if (std::floor(rate_hz) != rate_hz) return rate_hz;
  const double samples = std::round(rate_hz * kPacket_s);
  const double exact = samples / kPacket_s;
  return samples >= 1.0 && std::abs(exact - rate_hz) <= 0.5 ? exact : rate_hz;
}

void put_devices_before_names(TableLayout& layout, const std::vector<std::string>& devices) {
  std::vector<TableColumn>& columns = layout.columns;
  std::map<std::string, int> count;
  for (const TableColumn& column : columns) {
    if (column.kind == Kind::channel) ++count[column.name];
  }
  std::string device;
  std::size_t renamed = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c < devices.size() && !devices[c].empty()) device = devices[c];
    TableColumn& column = columns[c];
    if (column.kind != Kind::channel || column.name.empty() || count[column.name] < 2 || device.empty()) continue;
    column.name = device + " " + column.name;
    ++renamed;
  }
  if (renamed > 0)
    layout.repairs.push_back(
        {layout.names_line + 1,
         fmt::format("{} channels share their names; they have their device's before them here", renamed)});
}

}  // namespace myoid::recording
