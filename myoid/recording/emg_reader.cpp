#include "myoid/recording/emg_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/amplifier_range.h"
#include "myoid/recording/anc_reader.h"
#include "myoid/recording/bids.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/edf_reader.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/makers/marker_table.h"
#include "myoid/recording/makers/nexus_section.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/recording/tables/instrument_names.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/tables/table_clock.h"

namespace myoid::recording {
namespace {

/// Reads a word for a voltage in free text: "microvolt", "uV", "[mV]".
std::optional<double> voltage_in(std::string_view text) {
  std::string word;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ' ';
    if (std::string_view(" ,()[]\t;=").find(c) != std::string_view::npos) {
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

/// Returns the word in brackets at the end of a channel's name, and the name before it: "BIC [mv]".
std::optional<std::pair<std::string, std::string>> unit_in_name(const std::string& label) {
  const std::size_t open = label.rfind('[');
  if (open == std::string::npos || !label.ends_with(']') || open + 2 >= label.size()) return std::nullopt;
  return std::pair(std::string(trim(std::string_view(label).substr(0, open))),
                   label.substr(open + 1, label.size() - open - 2));
}

/// Says which channel's unit is unknown; empty if no channel without a unit states one.
std::string unknown_unit(const CsvSeries& series, const std::map<std::string, std::string>& units) {
  for (std::size_t c = 0; c < series.has_unit.size(); ++c) {
    const std::string& label = series.data.channels()[c].name;
    if (series.has_unit[c] || named_as_no_emg(label)) continue;
    auto found = unit_in_name(label);
    if (const auto row = units.find(label); row != units.end()) found = {label, row->second};
    if (found)
      return fmt::format("unit '{}' of channel {} is not known; known are V, mV, uV", found->second, found->first);
  }
  return {};
}

[[noreturn]] void throw_without_unit(const std::filesystem::path& path, const std::string& unknown) {
  throw ReadError(path, 0,
                  "{}; give it as --unit uV (or mV, V), in a study as [emg] unit = \"uV\", or kind = "
                  "\"envelope\" if this is no raw EMG",
                  unknown.empty() ? "the unit of the EMG is not stated in the file" : unknown);
}

bool has_column_beyond_amplifiers(const Eigen::MatrixXd& values_v) {
  for (Eigen::Index c = 0; c < values_v.cols(); ++c)
    if (is_beyond_amplifiers(values_v.col(c))) return true;
  return false;
}

/// Says why a file's own unit is not believed.
std::string given_for_volts(double to_volt) {
  return fmt::format("no amplifier gives the volts that the file states; read in {}, the unit given",
                     voltage_name(to_volt));
}

TimeSeries with_unit(const TimeSeries& series, Unit unit, double factor) {
  std::vector<Channel> channels = series.channels();
  for (Channel& channel : channels) channel.unit = unit;
  return {series.time_s(), std::move(channels), factor * series.values()};
}

/// Returns columns in volts unchanged and columns without a unit times `to_volt`; columns in
/// another unit are no EMG and are left out. Empty if a factor is needed and there is none. Columns whose volts no
/// amplifier gives take the unit given, too.
std::optional<TimeSeries> volts_of(const CsvSeries& series,
                                   std::optional<double> to_volt,
                                   std::vector<Repair>& repairs) {
  std::vector<std::string> kept;
  std::vector<double> factors;
  bool stated = false;
  std::vector<std::string> other_instruments, no_volts;
  std::map<std::string, std::vector<std::string>> other_units;
  for (std::size_t c = 0; c < series.has_unit.size(); ++c) {
    const Channel& channel = series.data.channels()[c];
    if (named_as_no_emg(channel.name)) {
      other_instruments.push_back(channel.name);
      continue;
    }
    if (series.has_unit[c] && channel.unit != Unit::volt) {
      other_units[std::string(symbol(channel.unit))].push_back(channel.name);
      continue;
    }
    if (!series.has_unit[c] && !to_volt) return std::nullopt;
    const bool wrong =
        series.has_unit[c] && to_volt && is_beyond_amplifiers(series.data.values().col(static_cast<Eigen::Index>(c)));
    if (wrong) no_volts.push_back(channel.name);
    stated = stated || (series.has_unit[c] && !wrong);
    kept.push_back(channel.name);
    factors.push_back(series.has_unit[c] && !wrong ? 1.0 : *to_volt);
  }
  for (const auto& [unit, names] : other_units)
    note(repairs, "no EMG since in {}, left out: {}", unit, fmt::join(names, ", "));
  if (!other_instruments.empty())
    note(repairs, "left out, because their names are no EMG's: {}", fmt::join(other_instruments, ", "));
  if (!no_volts.empty()) note(repairs, "{}: {}", some_of(no_volts), given_for_volts(*to_volt));
  if (stated && to_volt) note(repairs, "columns that name their unit keep it; the unit given is for the others");
  TimeSeries chosen = with_unit(series.data.select(kept), Unit::volt, 1.0);
  Eigen::MatrixXd values = chosen.values();
  for (std::size_t c = 0; c < factors.size(); ++c) values.col(static_cast<Eigen::Index>(c)) *= factors[c];
  return TimeSeries(chosen.time_s(), chosen.channels(), std::move(values));
}

/// Converts columns to SI where a line of the header names their unit.
CsvSeries with_named_units(Storage storage) {
  CsvSeries series;
  std::vector<Channel> channels = storage.data.channels();
  Eigen::MatrixXd values = storage.data.values();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto named = storage.units.find(channels[c].name);
    const auto unit = named == storage.units.end() ? std::nullopt : parse_file_unit(named->second);
    series.has_unit.push_back(unit.has_value());
    if (!unit) continue;
    channels[c].unit = unit->unit;
    values.col(static_cast<Eigen::Index>(c)) *= unit->to_si;
  }
  series.data = TimeSeries(storage.data.time_s(), std::move(channels), std::move(values));
  return series;
}

CsvSeries channels_of_table(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  if (is_marker_table(text) && !nexus_section(TableText(text), "Devices", path))
    throw ReadError(
        path, 0,
        "this is a table of markers and holds no EMG; give the export of the analog channels (of Nexus the devices)");
  return parse_emg_table(text, path);
}

/// Reads the analog channels of a C3D file; with `voltages_only`, leaves out force plates and
/// channels in another unit than volt.
CsvSeries channels_of_c3d(const std::filesystem::path& path, bool voltages_only) {
  std::vector<bool> has_unit;
  Recording file = read_c3d_channels(path, has_unit);
  if (file.analog.empty()) throw ReadError(path, 0, "the C3D file holds no analog channels, so no EMG");
  CsvSeries series;
  std::vector<std::string> names;
  std::vector<std::string> others;
  std::set<Eigen::Index> of_plates;
  for (const PlateSetup& plate : file.plates) of_plates.insert(plate.channels.begin(), plate.channels.end());
  for (std::size_t c = 0; c < has_unit.size(); ++c) {
    const Channel& channel = file.analog.channels()[c];
    if (voltages_only &&
        ((has_unit[c] && channel.unit != Unit::volt) || of_plates.contains(static_cast<Eigen::Index>(c)))) {
      others.push_back(channel.name);
      continue;
    }
    names.push_back(channel.name);
    series.has_unit.push_back(has_unit[c]);
  }
  if (names.empty())
    throw ReadError(path, 0, "none of the analog channels is a voltage beside the force plates', so there is no EMG");
  if (!others.empty()) note(file.repairs, "no voltage, or of a force plate, left out: {}", some_of(others));
  series.data = file.analog.select(names);
  series.repairs = std::move(file.repairs);
  return series;
}

/// Reads the channels of a format that can name their units; empty for storage files, which cannot,
/// and for formats without channels.
std::optional<CsvSeries> read_channels(const std::filesystem::path& path, bool voltages_only) {
  const auto format = format_of(path);
  if (!format) return std::nullopt;
  switch (*format) {
    case FileFormat::text_table:
      return channels_of_table(path);
    case FileFormat::c3d:
      return channels_of_c3d(path, voltages_only);
    case FileFormat::anc: {
      AncFile file = read_anc(path);
      const auto count = static_cast<std::size_t>(file.data.channel_count());
      return CsvSeries{std::move(file.data), std::vector<bool>(count, true), std::move(file.repairs)};
    }
    case FileFormat::edf: {
      EdfFile file = read_edf(path);
      CsvSeries series{{file.data.series(), std::move(file.has_unit)}, std::move(file.repairs)};
      for (EdfSignals& other : file.other_clocks)
        series.other_clocks.push_back({other.data.series(), std::move(other.has_unit)});
      return series;
    }
    case FileFormat::bids_motion:
      throw ReadError(path, 0, "this is a motion of BIDS and holds no EMG; give its _emg file");
    case FileFormat::storage:
    case FileFormat::trc:
    case FileFormat::mesh_vtp:
    case FileFormat::mesh_stl:
    case FileFormat::mesh_obj:
    case FileFormat::model:
    case FileFormat::set_up:
    case FileFormat::toml:
      break;
  }
  return std::nullopt;
}

/// EMG-BIDS: keeps the EMG channels that are not bad, takes their unit from `_channels.tsv` where
/// the file has none, and the muscle of each.
void apply_bids(const std::filesystem::path& path, CsvSeries& series, EmgFile& file) {
  const auto channels = bids_channels_of(path);
  if (!channels) return;
  std::vector<std::string> kept;
  std::vector<bool> has_unit;
  std::vector<Channel> renewed;
  std::vector<double> factors;
  std::vector<std::string> bad, others;
  double other_hz = 0.0;
  for (const BidsChannel& channel : *channels) {
    const auto column = series.data.find(channel.name);
    if (!column) {
      note(series.repairs, "channel '{}' of the _channels.tsv is not in the file", channel.name);
      continue;
    }
    if (!equal_ignoring_case(channel.type, "EMG")) {
      others.push_back(channel.name);
      continue;
    }
    if (channel.bad) {
      bad.push_back(channel.name);
      continue;
    }
    const auto c = static_cast<std::size_t>(*column);
    const auto unit = parse_file_unit(channel.unit);
    const bool take = !series.has_unit[c] && unit;
    constexpr double kOther = 0.01;
    if (std::abs(channel.rate_hz / series.data.mean_rate_hz() - 1.0) > kOther && channel.rate_hz > 0.0)
      other_hz = channel.rate_hz;
    kept.push_back(channel.name);
    has_unit.push_back(series.has_unit[c] || take);
    renewed.push_back({channel.name, take ? unit->unit : series.data.channels()[c].unit});
    factors.push_back(take ? unit->to_si : 1.0);
    if (!channel.target_muscle.empty()) file.target_muscle[channel.name] = channel.target_muscle;
  }
  if (kept.empty()) throw ReadError(path, 0, "none of the channels of its _channels.tsv is EMG and good");
  if (other_hz > 0.0)
    series.repairs.push_back(
        other_rate(0, other_hz, series.data.mean_rate_hz(), static_cast<double>(series.data.sample_count() - 1)));
  if (!others.empty()) note(series.repairs, "no EMG by the _channels.tsv, left out: {}", some_of(others));
  if (!bad.empty()) note(series.repairs, "channels marked as bad are left out: {}", fmt::join(bad, ", "));
  Eigen::MatrixXd values = series.data.select(kept).values();
  for (std::size_t c = 0; c < factors.size(); ++c) values.col(static_cast<Eigen::Index>(c)) *= factors[c];
  series.data = TimeSeries(series.data.time_s(), std::move(renewed), std::move(values));
  series.has_unit = std::move(has_unit);
}

/// Keeps the channels asked for and whether their units are known.
void restrict_to(const std::vector<std::string>& wanted, const std::filesystem::path& path, CsvSeries& series) {
  if (wanted.empty()) return;
  std::vector<const ClockedChannels*> groups{&series};
  for (const ClockedChannels& group : series.other_clocks) groups.push_back(&group);
  std::vector<AnalogChannels> clocks;
  for (const ClockedChannels* group : groups) clocks.emplace_back(group->data);
  std::vector<const AnalogChannels*> views;
  for (const AnalogChannels& clock : clocks) views.push_back(&clock);
  TimeSeries chosen = choose_channels(views, wanted, path);
  std::vector<bool> has_unit;
  for (const Channel& channel : chosen.channels()) {
    for (const ClockedChannels* group : groups) {
      if (const auto column = group->data.find(channel.name))
        has_unit.push_back(group->has_unit[static_cast<std::size_t>(*column)]);
    }
  }
  series.data = std::move(chosen);
  series.has_unit = std::move(has_unit);
}

/// Notes the channels that may be EMG and are not on the first clock.
void state_other_clocks(CsvSeries& series) {
  std::vector<std::string> names;
  for (const ClockedChannels& clock : series.other_clocks) {
    for (std::size_t c = 0; c < clock.has_unit.size(); ++c) {
      const Channel& channel = clock.data.channels()[c];
      const bool voltage = !clock.has_unit[c] || channel.unit == Unit::volt;
      if (voltage && !named_as_no_emg(channel.name)) names.push_back(channel.name);
    }
  }
  if (!names.empty()) series.repairs.push_back({0, first_clock_alone(names)});
}

}  // namespace

std::optional<double> stated_voltage(const Storage& storage) {
  std::optional<double> stated = voltage_in(storage.title);
  for (const auto& [key, value] : storage.header) {
    if (!stated && (equal_ignoring_case(key, "unit") || equal_ignoring_case(key, "units"))) stated = voltage_in(value);
  }
  return stated;
}

std::string voltage_name(double to_volt) {
  return to_volt == 1.0 ? "V" : to_volt == 1e-3 ? "mV" : to_volt == 1e-6 ? "uV" : fmt::format("{} V", to_volt);
}

EmgFile read_emg(const std::filesystem::path& path,
                 const std::string& unit,
                 bool dimensionless,
                 const std::vector<std::string>& wanted) {
  std::optional<double> to_volt;
  if (!unit.empty()) {
    const auto parsed = parse_unit(unit);
    if (!parsed || parsed->unit != Unit::volt) {
      throw InvalidInput("EMG unit: found '{}', expected V, mV or uV", unit);
    }
    to_volt = parsed->to_si;
  }
  EmgFile file;
  std::string unknown;
  std::optional<TimeSeries> series;
  if (std::optional<CsvSeries> table = read_channels(path, !dimensionless)) {
    apply_bids(path, *table, file);
    restrict_to(wanted, path, *table);
    if (wanted.empty()) state_other_clocks(*table);
    file.repairs = std::move(table->repairs);
    series = dimensionless ? with_unit(table->data, Unit::dimensionless, 1.0) : volts_of(*table, to_volt, file.repairs);
    unknown = unknown_unit(*table, {});
  } else {
    Storage storage = read_storage(path);
    file.repairs = std::move(storage.repairs);
    if (!wanted.empty()) {
      const AnalogChannels all(std::move(storage.data));
      storage.data = choose_channels({&all}, wanted, path);
    }
    std::optional<double> stated = stated_voltage(storage);
    if (stated && to_volt && *to_volt < *stated && has_column_beyond_amplifiers(*stated * storage.data.values())) {
      note(file.repairs, "{}", given_for_volts(*to_volt));
      stated = std::nullopt;
      storage.units.clear();
    }
    if (stated && to_volt && *stated != *to_volt && !dimensionless) {
      file.unit_conflict = fmt::format(
          "the file says that it is in {}, so the unit given ({}) is not used; if the file is wrong, correct its title",
          voltage_name(*stated), unit);
    }
    if (stated) to_volt = stated;
    if (dimensionless) {
      series = std::move(storage.data);
    } else if (!stated && !storage.units.empty()) {
      const std::map<std::string, std::string> units = storage.units;
      const CsvSeries named = with_named_units(std::move(storage));
      unknown = unknown_unit(named, units);
      series = volts_of(named, to_volt, file.repairs);
    } else if (to_volt) {
      series = with_unit(storage.data, Unit::volt, *to_volt);
    }
  }
  if (!series) throw_without_unit(path, unknown);
  if (series->channel_count() == 0) throw ReadError(path, 0, "there is no EMG channel beside the time");
  file.data = std::move(*series);
  return file;
}

}  // namespace myoid::recording
