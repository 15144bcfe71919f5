#include "myoid/recording/tables/channel_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

bool in_seconds(const TableColumn& column) { return column.unit && column.unit->unit == Unit::second; }

/// Returns true for a column that is the clock of the channels behind it, as in tables with a clock for each channel:
/// "X[s]", and "X[s].1" of programs that make names unique, or "EMG 1 Time Series (s)".
bool is_time_of_channel(const TableColumn& column) {
  const std::string name = lower(column.name);
  if (name.starts_with("x[s]")) return true;
  return in_seconds(column) && (name == "x" || name.ends_with("time series"));
}

bool names_clock(std::string_view text);

/// Returns the unit behind the last underscore of a name: "time_ms", "EMG_BIC_mV". Words that end the names of muscles
/// ("flexor_carpi_rad", "vas_m") are none.
std::optional<ScaledUnit> unit_behind_bar(std::string_view name) {
  static const std::set<std::string, std::less<>> kWords{"mv", "uv",  "µv",   "nm", "deg", "mm",
                                                         "s",  "sec", "msec", "ms", "us",  "usec"};
  const std::size_t bar = name.rfind('_');
  if (bar == std::string_view::npos || bar == 0 || !kWords.contains(lower(name.substr(bar + 1)))) return std::nullopt;
  const auto unit = parse_file_unit(name.substr(bar + 1));
  return unit && (unit->unit != Unit::second || names_clock(name.substr(0, bar))) ? unit : std::nullopt;
}

/// Returns the column of a label whose unit stands behind a comma, a slash, or the word "in": "EMG, mV", "EMG/mV",
/// "EMG in mV". "Moment Nm/kg" and "m/s" are none.
std::optional<TableColumn> unit_behind_mark(std::string_view text) {
  for (const std::string_view mark : {",", "/", " in "}) {
    const std::size_t at = mark == "," ? text.rfind(mark) : text.find(mark);
    if (at == std::string_view::npos || at == 0) continue;
    const auto unit = parse_file_unit(text.substr(at + mark.size()));
    const std::string_view name = trim(text.substr(0, at));
    const auto words = split_words(name);
    if (unit && !words.empty() && !(mark == "/" && parse_file_unit(words.back())))
      return TableColumn{Kind::channel, std::string(name), unit};
  }
  return std::nullopt;
}

/// Returns true if a word of the name is "timestamp" or "timestampsync": "Shimmer_68B7_Timestamp_Unix_CAL".
bool speaks_of_timestamp(const std::string& name) {
  const std::string_view word = "timestamp", synchronized = "sync";
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  for (std::size_t i = name.find(word); i != std::string::npos; i = name.find(word, i + 1)) {
    std::size_t end = i + word.size();
    if (name.compare(end, synchronized.size(), synchronized) == 0) end += synchronized.size();
    if ((i == 0 || !is_letter(name[i - 1])) && (end == name.size() || !is_letter(name[end]))) return true;
  }
  return false;
}

/// Returns true for the name of a clock; a unit of time may stand behind it ("time_ms").
bool names_clock(std::string_view text) {
  static const std::set<std::string> kWords{"time",  "t",      "times",       "time stamp", "zeit",
                                            "temps", "tiempo", "time series", "abs time",   "x_value"};
  const std::string name = lower(trim(text));
  if (kWords.contains(name) || speaks_of_timestamp(name)) return true;
  const std::size_t bar = name.rfind('_');
  return bar != std::string::npos && unit_behind_bar(name) && kWords.contains(name.substr(0, bar));
}

/// Returns true for the name of a clock in seconds or in a stated unit of time.
bool is_time(const TableColumn& column) { return names_clock(column.name) && (!column.unit || in_seconds(column)); }

/// Returns true for the name of a clock that stands again: "time", or "time.1", "time_2" of programs that make names
/// unique.
bool is_name_again(const TableColumn& column, const TableColumn& clock) {
  if ((column.unit && !in_seconds(column)) || !column.name.starts_with(clock.name)) return false;
  const std::string_view rest = std::string_view(column.name).substr(clock.name.size());
  const std::size_t digit = rest.find_first_of("0123456789");
  constexpr std::size_t kShortest = 2;  // "t1" is a channel
  return rest.empty() || (clock.name.size() >= kShortest && digit <= 1 && rest.find_first_not_of("._ ") == digit &&
                          rest.find_first_not_of("0123456789", digit) == std::string_view::npos);
}

/// Returns the unit of time that a column has for a name: "mSec".
std::optional<ScaledUnit> time_unit_as_name(const TableColumn& column) {
  static const std::set<std::string> kWords{"ms", "msec", "msecs", "millisec", "s", "sec", "secs", "seconds"};
  return !column.unit && kWords.contains(lower(column.name)) ? parse_file_unit(column.name) : std::nullopt;
}

Kind kind_by_name(const TableColumn& column) {
  if (column.unit) return Kind::channel;  // "marker [mm]", "index [N]"
  static const std::map<Kind, std::set<std::string>> kWords{
      {Kind::frame,
       {"frame", "frames", "frame#", "sample", "samples", "sample #", "#sample", "sample number", "index", "#", "no",
        "no.", "nr"}},
      {Kind::sub_frame, {"sub frame", "subframe", "sub frame#"}},
      {Kind::remark, {"marker", "markers", "activity", "event", "events", "comment", "comments", "remark", "note"}}};
  const std::string word = lower(column.name);
  for (const auto& [kind, words] : kWords)
    if (words.contains(word)) return kind;
  return Kind::channel;
}

/// A whole number in brackets at the end of a label: "C7[1]".
struct LabelIndex {
  std::string base;
  std::string number;
  bool against_name = false;  ///< No blank stands between name and bracket.
};

std::optional<LabelIndex> index_in(std::string_view label) {
  const std::size_t open = label.find_last_of("[(");
  if (open == std::string_view::npos || open == 0 || (label.back() != ']' && label.back() != ')')) return std::nullopt;
  const std::string_view number = label.substr(open + 1, label.size() - open - 2);
  if (number.empty() || number.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  return LabelIndex{std::string(trim(label.substr(0, open))), std::string(number), label[open - 1] != ' '};
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
  return parse_file_unit(cell);
}

std::optional<double> hertz_in_cell(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() < 3 || !equal_ignoring_case(cell.substr(cell.size() - 2), "hz")) return std::nullopt;
  cell.remove_suffix(2);
  const bool kilo = cell.back() == 'k' || cell.back() == 'K';
  if (kilo) cell.remove_suffix(1);
  auto number = parse_number(trim(cell));
  if (!number) number = parse_comma_number(trim(cell));
  return number && kilo ? std::optional(1000.0 * *number) : number;
}

std::optional<double> rate_in_cell(std::string_view cell) {
  const auto rate = hertz_in_cell(cell);
  return rate && *rate > 0.0 && *rate <= 1e6 ? rate : std::nullopt;
}

bool is_pattern_of_times(std::string_view cell) {
  const std::string text = lower(trim(cell));
  return text.find("hh:mm") != std::string::npos && text.find_first_not_of("ymdhst0fz/-.:, ") == std::string::npos;
}

std::optional<double> period_in_cell(std::string_view cell) {
  cell = trim(cell);
  const std::size_t end = std::min(cell.find_first_not_of("0123456789.,eE+-"), cell.size());
  const auto unit = parse_file_unit(cell.substr(end));
  auto number = parse_number(trim(cell.substr(0, end)));
  if (!number) number = parse_comma_number(trim(cell.substr(0, end)));
  if (!number || !unit || unit->unit != Unit::second) return std::nullopt;
  const double period_s = *number * unit->to_si;
  return period_s >= 1e-6 && period_s <= 1e3 ? std::optional(period_s) : std::nullopt;
}

TableColumn take_label_apart(const std::string& text) {
  TableColumn column;
  column.name = text;
  if (const auto index = index_in(text); index && index->against_name) return column;
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t begin = column.name.rfind(open);
    const std::size_t end = column.name.rfind(close);
    if (begin == std::string::npos || end == std::string::npos || end < begin) continue;
    const std::string inside = column.name.substr(begin + 1, end - begin - 1);
    const auto rate = rate_in_cell(inside);
    auto unit = rate ? std::nullopt : parse_file_unit(inside);
    // The word "min" means minutes behind a clock's name, and the least value behind another.
    if (!rate && equal_ignoring_case(inside, "min") && names_clock(column.name.substr(0, begin)))
      unit = ScaledUnit{Unit::second, 60.0};
    if (!rate && !unit) continue;
    if (column.unit && unit && unit->unit == Unit::dimensionless) continue;  // "IN 1(2)[mV]": an index
    if (rate) column.rate_hz = packet_rate(*rate);
    if (unit) column.unit = unit;
    column.name = std::string(trim(column.name.substr(0, begin)));
  }
  if (column.unit || column.rate_hz > 0.0) return column;
  if (auto marked = unit_behind_mark(text)) return *std::move(marked);
  column.unit = unit_behind_bar(text);
  return column;
}

namespace {

/// Returns the end of a number that begins at `at` of `text`. A comma belongs to the number where a unit of rates or
/// nothing stands behind the digits after it and commas part no cells.
std::size_t end_of_number(std::string_view text, std::size_t at) {
  const auto digits = [&](std::size_t from, bool points) {
    while (from < text.size() && ((text[from] >= '0' && text[from] <= '9') || (points && text[from] == '.'))) ++from;
    return from;
  };
  const std::size_t whole = digits(at, true);
  if (whole >= text.size() || text[whole] != ',') return whole;
  const std::size_t end = digits(whole + 1, false);
  if (end == whole + 1) return whole;
  const std::string behind = word_at(text, std::min(text.find_first_not_of(" [(", end), text.size()));
  const bool other_separator = text.substr(0, at).find_first_of(";\t") != std::string_view::npos;
  return behind == "hz" || behind == "khz" || other_separator ? end : whole;
}

/// Returns the rate of "2000", "1925,926", "2,0", or "2,000" in Hz, which are thousands: nothing is sampled at 2 Hz.
std::optional<double> number_of_rate(std::string_view text, bool kilo) {
  const auto number = parse_number(text);
  const std::size_t comma = text.find(',');
  if (number || comma == std::string_view::npos) return number;
  constexpr double kSlowest_hz = 20.0;
  const auto decimal = parse_comma_number(text);
  if (!decimal || kilo || *decimal >= kSlowest_hz || text.size() - comma != 4) return decimal;
  return parse_number(std::string(text.substr(0, comma)) + std::string(text.substr(comma + 1)));
}

/// A word that speaks of a rate. One that need not be that of the samples counts only behind a word of `kRateOf`.
struct RateWord {
  std::string_view text;
  bool of_samples = true;
};

constexpr std::array kRateWords{
    RateWord{"sampling frequency"}, RateWord{"sampling rate"},  RateWord{"sample rate"},      RateWord{"samplerate"},
    RateWord{"sample frequency"},   RateWord{"samplingrate"},   RateWord{"samplefrequentie"}, RateWord{"abtastrate"},
    RateWord{"abtastfrequenz"},     RateWord{"chantillonnage"}, RateWord{"muestreo"},         RateWord{"campionamento"},
    RateWord{"frequency", false},   RateWord{"rate", false},    RateWord{"fs", false}};

/// Words before "rate" and "frequency" with which these may be the samples'. A heart rate, a baud rate and the
/// frequency of a filter or of the mains are none.
const std::set<std::string, std::less<>> kRateOf{
    "",        "s",         "acq",     "adc",        "daq",    "acquisition", "analog", "analogue", "base",
    "camera",  "capture",   "channel", "collection", "data",   "device",      "emg",    "export",   "file",
    "force",   "frame",     "imu",     "input",      "logger", "logging",     "mean",   "mess",     "motion",
    "nominal", "output",    "plate",   "point",      "record", "recording",   "sample", "sampling", "scan",
    "sensor",  "signal",    "the",     "time",       "trial",  "update",      "video",  "marker",   "frames",
    "average", "measuring", "signals", "measurement"};

/// Returns the letters that end at `end`, or, where none stand there, the word before the blank.
std::string_view word_before(std::string_view text, std::size_t end) {
  const auto letters = [&] {
    std::size_t begin = end;
    while (begin > 0 && text[begin - 1] >= 'a' && text[begin - 1] <= 'z') --begin;
    return text.substr(begin, end - begin);
  };
  if (const std::string_view attached = letters(); !attached.empty()) return attached;
  while (end > 0 && (text[end - 1] == ' ' || text[end - 1] == '_' || text[end - 1] == '-')) --end;
  return letters();
}

/// Reads the rate behind `begin`, where a word for a rate ends.
std::optional<StatedRate> rate_behind(std::string_view text, std::size_t begin, bool of_samples) {
  std::size_t i = begin;
  std::string unit;
  while (i < text.size() && (text[i] < '0' || text[i] > '9')) {
    const std::string before = word_at(text, i);
    if (!before.empty() && before != "hz" && before != "khz") break;
    if (!before.empty()) unit = before;
    i += std::max<std::size_t>(1, before.size());
  }
  std::size_t end = end_of_number(text, i);
  const std::string_view digits = text.substr(i, end - i);
  while (end < text.size() && std::string_view(" \t;[(").find(text[end]) != std::string_view::npos) ++end;
  if (const std::string behind = word_at(text, end); !behind.empty()) unit = behind;
  const auto number = number_of_rate(digits, unit == "khz");
  if (!number) return std::nullopt;
  for (const char* other : {"mhz", "ghz", "ms", "us", "ns", "bpm", "rpm"})
    if (unit == other) return StatedRate{.hz = 0.0, .other_unit = unit, .of_samples = of_samples};
  const double rate = unit == "khz" ? 1000.0 * *number : *number;
  if (!(rate >= 1.0 && rate <= 1e6)) return std::nullopt;
  return StatedRate{.hz = rate, .other_unit = {}, .of_samples = of_samples};
}

}  // namespace

std::optional<StatedRate> rate_in_line(std::string_view line) {
  const std::string text = lower(line);
  for (const RateWord& word : kRateWords) {
    for (std::size_t at = text.find(word.text); at != std::string::npos; at = text.find(word.text, at + 1)) {
      if (!word.of_samples && !kRateOf.contains(word_before(text, at))) continue;
      if (const auto rate = rate_behind(text, at + word.text.size(), word.of_samples)) return rate;
    }
  }
  return std::nullopt;
}

std::vector<StatedRate> rates_in_lines(std::span<const std::string_view> lines) {
  std::vector<StatedRate> rates;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    auto rate = rate_in_line(lines[n]);
    if (!rate) continue;
    rate->line = n + 1;
    if (rate->of_samples && !rates.empty() && !rates[0].of_samples) rates.clear();
    if (rates.empty() || rate->of_samples == rates[0].of_samples) rates.push_back(*std::move(rate));
  }
  return rates;
}

std::vector<TableColumn> take_labels_apart(const std::vector<std::string>& texts) {
  std::map<std::string, std::set<std::string>> numbers;
  for (const std::string& text : texts)
    if (const auto index = index_in(text)) numbers[index->base].insert(index->number);
  std::vector<TableColumn> columns;
  for (const std::string& text : texts) {
    const auto index = index_in(text);
    const bool counts = index && numbers[index->base].size() > 1;
    columns.push_back(counts ? TableColumn{Kind::channel, text} : take_label_apart(text));
  }
  return columns;
}

std::optional<std::size_t> plain_clock(const std::vector<TableColumn>& columns) {
  std::optional<std::size_t> found;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!is_time(columns[c])) continue;
    if (lower(columns[c].name) != "t") return c;
    if (!found) found = c;
  }
  return found;
}

void set_kinds(TableLayout& layout) {
  std::vector<TableColumn>& columns = layout.columns;
  const auto plain = plain_clock(columns);
  const bool of_channels = std::ranges::any_of(columns, is_time_of_channel);
  std::vector<std::string> others;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    TableColumn& column = columns[c];
    const bool repeats = plain && c != *plain && is_name_again(column, columns[*plain]);
    if ((plain && c == *plain) || is_time_of_channel(column) || (repeats && c > *plain + 1)) {
      column.kind = Kind::time;
    } else {
      column.kind = kind_by_name(column);
      if ((is_time(column) && column.name.size() > 1) || repeats) others.push_back(column.name);
    }
  }
  if (!plain && !of_channels && !columns.empty()) {
    if (const auto unit = time_unit_as_name(columns[0])) columns[0].unit = unit;
    if (in_seconds(columns[0])) columns[0].kind = Kind::time;  // "Elapsed Time (s)"
  }
  if (!others.empty())
    layout.repairs.push_back(
        {layout.names_line + 1, fmt::format("a channel here, since the clock is '{}': {}",
                                            plain ? columns[*plain].name : "X[s]", fmt::join(others, ", "))});
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
