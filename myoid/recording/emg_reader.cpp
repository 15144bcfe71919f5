#include "myoid/recording/emg_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "myoid/core/error.h"
#include "myoid/recording/csv_reader.h"
#include "myoid/recording/storage_reader.h"

namespace myoid::recording {
namespace {

/// A voltage word in free text: "microvolt", "uV", "[mV]".
std::optional<double> voltage_in(std::string_view text) {
  std::string word;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ' ';
    if (c == ' ' || c == ',' || c == '(' || c == ')' || c == '[' || c == ']' || c == '\t' || c == ';' || c == '=') {
      for (const std::string& candidate : {word, word + "s"}) {
        const auto unit = parse_unit(candidate);
        if (unit && unit->unit == Unit::volt) return unit->to_si;
      }
      word.clear();
    } else {
      word += c;
    }
  }
  return std::nullopt;
}

TimeSeries with_unit(const TimeSeries& series, Unit unit, double factor) {
  std::vector<Channel> channels = series.channels();
  for (Channel& channel : channels) channel.unit = unit;
  return {series.time_s(), std::move(channels), factor * series.values()};
}

}  // namespace

EmgFile read_emg(const std::filesystem::path& path, const std::string& unit, bool dimensionless) {
  std::optional<double> to_volt;
  if (!unit.empty()) {
    const auto parsed = parse_unit(unit);
    if (!parsed || parsed->unit != Unit::volt) {
      throw InvalidInput(fmt::format("EMG unit: found '{}', expected V, mV or uV", unit));
    }
    to_volt = parsed->to_si;
  }
  EmgFile file;
  TimeSeries numbers;
  if (equal_ignoring_case(path.extension().string(), ".csv")) {
    CsvSeries series = read_csv_series(path);
    file.repairs = std::move(series.repairs);
    const bool volts = std::all_of(series.data.channels().begin(), series.data.channels().end(),
                                   [](const Channel& c) { return c.unit == Unit::volt; });
    if (volts && !dimensionless) {
      file.data = std::move(series.data);
      return file;
    }
    numbers = std::move(series.data);
  } else {
    Storage storage = read_storage(path);
    file.repairs = std::move(storage.repairs);
    if (!to_volt) to_volt = voltage_in(storage.title);
    for (const auto& [key, value] : storage.header) {
      if (!to_volt && equal_ignoring_case(key, "unit")) to_volt = voltage_in(value);
      if (!to_volt && equal_ignoring_case(key, "units")) to_volt = voltage_in(value);
    }
    numbers = std::move(storage.data);
  }
  if (dimensionless) {
    file.data = with_unit(numbers, Unit::dimensionless, 1.0);
  } else if (to_volt) {
    file.data = with_unit(numbers, Unit::volt, *to_volt);
  } else {
    throw ReadError(path, 0, "the unit of the EMG is not stated in the file; give it as --unit uV (or mV, V), in a study as [emg] unit = \"uV\", or "
                             "kind = \"envelope\" if this is no raw EMG");
  }
  return file;
}

}  // namespace myoid::recording
