#include "myoid/recording/emg_reader.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

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
    if (c == ' ' || c == ',' || c == '(' || c == ')' || c == '[' || c == ']' || c == '\t' ||
        c == ';' || c == '=') {
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

/// Columns in volts as they are, those without a unit times `to_volt`; those in another unit are no
/// EMG and left out. Empty if a factor is needed and there is none.
std::optional<TimeSeries> volts_of(const CsvSeries& series,
                                   std::optional<double> to_volt,
                                   std::vector<Repair>& repairs) {
  std::vector<std::string> kept;
  std::vector<double> factors;
  bool stated = false;
  for (std::size_t c = 0; c < series.has_unit.size(); ++c) {
    const Channel& channel = series.data.channels()[c];
    if (series.has_unit[c] && channel.unit != Unit::volt) {
      repairs.push_back({0, fmt::format("column '{}' is in {} and no EMG; left out", channel.name,
                                        symbol(channel.unit))});
      continue;
    }
    if (!series.has_unit[c] && !to_volt) return std::nullopt;
    stated = stated || series.has_unit[c];
    kept.push_back(channel.name);
    factors.push_back(series.has_unit[c] ? 1.0 : *to_volt);
  }
  if (stated && to_volt)
    repairs.push_back(
        {0, "columns that name their unit keep it; the unit given is for the others"});
  TimeSeries chosen = with_unit(series.data.select(kept), Unit::volt, 1.0);
  Eigen::MatrixXd values = chosen.values();
  for (std::size_t c = 0; c < factors.size(); ++c)
    values.col(static_cast<Eigen::Index>(c)) *= factors[c];
  return TimeSeries(chosen.time_s(), chosen.channels(), std::move(values));
}

bool is_table(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return equal_ignoring_case(extension, ".csv") || equal_ignoring_case(extension, ".tsv") ||
         equal_ignoring_case(extension, ".txt");
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
  std::optional<TimeSeries> series;
  if (is_table(path)) {
    CsvSeries table = read_csv_series(path);
    file.repairs = std::move(table.repairs);
    series = dimensionless ? with_unit(table.data, Unit::dimensionless, 1.0)
                           : volts_of(table, to_volt, file.repairs);
  } else {
    Storage storage = read_storage(path);
    file.repairs = std::move(storage.repairs);
    if (!to_volt) to_volt = voltage_in(storage.title);
    for (const auto& [key, value] : storage.header) {
      if (!to_volt && (equal_ignoring_case(key, "unit") || equal_ignoring_case(key, "units")))
        to_volt = voltage_in(value);
    }
    if (dimensionless) {
      series = std::move(storage.data);
    } else if (to_volt) {
      series = with_unit(storage.data, Unit::volt, *to_volt);
    }
  }
  if (!series) {
    throw ReadError(
        path, 0,
        "the unit of the EMG is not stated in the file; give it as --unit uV (or mV, V), "
        "in a study as [emg] unit = \"uV\", or kind = \"envelope\" if this is no raw EMG");
  }
  if (series->channel_count() == 0)
    throw ReadError(path, 0, "there is no EMG channel beside the time");
  file.data = std::move(*series);
  return file;
}

}  // namespace myoid::recording
