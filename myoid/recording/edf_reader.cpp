#include "myoid/recording/edf_reader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/event.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/edf_header.h"
#include "myoid/recording/tables/table_layout.h"
#include "myoid/recording/tables/table_series.h"

namespace myoid::recording {
namespace {

std::int32_t sample(const std::byte* p, bool bdf) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(p[i]); };
  if (bdf) return static_cast<std::int32_t>((byte(2) << 24U) | (byte(1) << 16U) | (byte(0) << 8U)) >> 8;
  return static_cast<std::int16_t>(static_cast<std::uint16_t>((byte(1) << 8U) | byte(0)));
}

/// Reads time-stamped annotation lists: "+onset[\x15duration]\x14text\x14...\x14\0". The first list
/// of a record has no text and states the record's own time.
std::optional<double> read_annotations(std::string_view bytes, std::vector<Event>& events) {
  std::optional<double> record_time;
  bool first = true;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\0');
    std::string_view list = bytes.substr(0, end);
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
    if (list.empty()) continue;
    const std::size_t head = list.find('\x14');
    if (head == std::string_view::npos) continue;
    const std::string_view stamp = list.substr(0, head);
    const auto onset = parse_number(stamp.substr(0, stamp.find('\x15')));
    if (!onset || !std::isfinite(*onset)) continue;
    if (first) record_time = onset;
    first = false;
    list.remove_prefix(head + 1);
    while (!list.empty()) {
      const std::size_t stop = list.find('\x14');
      if (const std::string label = to_utf8(list.substr(0, stop)); !label.empty())
        events.push_back({*onset, label, "", ""});
      list.remove_prefix(stop == std::string_view::npos ? list.size() : stop + 1);
    }
  }
  return record_time;
}

/// Returns the signals of each rate, the fastest first.
std::vector<std::vector<std::size_t>> signals_by_rate(const EdfHeader& header, std::vector<Repair>& repairs) {
  std::map<std::size_t, std::vector<std::size_t>, std::greater<>> by_rate;
  std::vector<std::string> broken;
  for (std::size_t s = 0; s < header.signals.size(); ++s) {
    const EdfSignal& signal = header.signals[s];
    if (signal.annotations || signal.per_record == 0) continue;
    if (signal.digital_min == signal.digital_max || signal.physical_min == signal.physical_max) {
      broken.push_back(signal.label);
      continue;
    }
    by_rate[signal.per_record].push_back(s);
  }
  if (!broken.empty())
    note(repairs, "signals left out, since their least and largest values are the same in the header: {}",
         fmt::join(broken, ", "));
  std::vector<std::vector<std::size_t>> clocks;
  for (auto& [per_record, list] : by_rate) clocks.push_back(std::move(list));
  return clocks;
}

/// Returns the unit of a signal. A sign that no one can read before the V, which writers put for the Greek letter, can
/// only be micro: the other prefixes are plain letters.
std::optional<ScaledUnit> unit_of_signal(const std::string& dimension) {
  if (const auto unit = parse_file_unit(dimension)) return unit;
  const std::string word = dimension.starts_with("\xEF\xBF\xBD") ? "?" + dimension.substr(3) : dimension;
  const bool micro = word.size() >= 2 && word.size() <= 4 && word.ends_with('V') &&
                     std::ranges::none_of(word.substr(0, word.size() - 1), [](unsigned char c) {
                       return c < 0x80 && std::string_view(".?_*").find(static_cast<char>(c)) == std::string_view::npos;
                     });
  return micro ? std::optional(ScaledUnit{Unit::volt, 1e-6}) : std::nullopt;
}

/// Returns storage for the samples: 16-bit samples stay 16 bits; a 32-bit real holds 24 bits.
decltype(AnalogCounts::values) room_for(const EdfHeader& header, Eigen::Index rows, std::size_t signals) {
  const auto columns = static_cast<Eigen::Index>(signals);
  if (header.bdf) return AnalogCounts::Columns<float>(rows, columns);
  return AnalogCounts::Columns<std::int16_t>(rows, columns);
}

/// Copies the samples of the chosen signals in a record, from row `first` on.
void take_samples(const EdfHeader& header,
                  const std::vector<std::size_t>& chosen,
                  std::span<const std::byte> record,
                  Eigen::Index first,
                  AnalogCounts& counts) {
  std::visit(
      [&](auto& values) {
        using Count = typename std::decay_t<decltype(values)>::Scalar;
        for (std::size_t c = 0; c < chosen.size(); ++c) {
          const EdfSignal& signal = header.signals[chosen[c]];
          const std::byte* p = record.data() + signal.offset;
          Count* out = &values(first, static_cast<Eigen::Index>(c));
          for (std::size_t i = 0; i < signal.per_record; ++i, p += header.sample_bytes)
            out[i] = static_cast<Count>(sample(p, header.bdf));
        }
      },
      counts.values);
}

/// Throws ReadError if a transfer as text explains why the file is longer than its header says.
void refuse_returns(const EdfHeader& header, ByteSource& source, const std::filesystem::path& path) {
  const std::uint64_t data = source.size() - header.bytes;
  const std::uint64_t said = header.records >= 0 ? static_cast<std::uint64_t>(header.records) * header.record_bytes : 0;
  const std::uint64_t more = header.records >= 0 && data > said ? data - said : data % header.record_bytes;
  if (more == 0) return;
  const TextMarks marks = text_marks(source, source.size());
  const bool explained = header.records >= 0 ? marks.returned == more : marks.line_feeds >= 4;
  if (marks.all_returned(1) && explained)
    throw ReadError(
        path, 0,
        "the file is {} bytes longer than its header says, and a carriage return stands before each of its {} "
        "line feeds: it was transferred as text; copy it again in binary mode",
        more, marks.line_feeds);
}

/// Returns the number of records to read: the complete ones in the file, at most as many as the header states.
std::int64_t record_count(const EdfHeader& header,
                          std::uint64_t file_bytes,
                          const std::filesystem::path& path,
                          std::vector<Repair>& repairs) {
  const std::uint64_t available = file_bytes - header.bytes;
  auto records = static_cast<std::int64_t>(available / header.record_bytes);
  const std::uint64_t left = available % header.record_bytes;
  if (header.records >= 0 && header.records < records) {
    note(repairs, "the header says {} records, the file has {}; {} are taken", header.records, records, header.records);
    records = header.records;
  } else if (header.records != records) {
    note(repairs, "the header says {} records, the file has {} whole ones, which are taken", header.records, records);
    repairs.back().lost = header.records > records;
  } else if (left != 0) {
    note(repairs,
         "{} bytes behind the last record belong to no record; if bytes were inserted, the samples are wrong: "
         "compare with the original",
         left);
  }
  if (records <= 0) throw ReadError(path, 0, "the file holds no whole record of samples");
  return records;
}

/// The channels of the chosen signals: names, units and the scales from counts to SI.
struct Scaled {
  std::vector<Channel> channels;
  std::vector<CountScale> scales;
  std::vector<bool> has_unit;
};

/// Gives each signal that is read a name of its own.
void name_signals(EdfHeader& header,
                  const std::vector<std::vector<std::size_t>>& clocks,
                  std::vector<Repair>& repairs) {
  std::vector<std::size_t> order;
  for (const auto& clock : clocks) order.insert(order.end(), clock.begin(), clock.end());
  std::ranges::sort(order);
  std::vector<std::string> names;
  for (const std::size_t s : order) {
    const std::string& label = header.signals[s].label;
    names.push_back(label.empty() ? fmt::format("signal_{}", s + 1) : label);
  }
  names = unique_names(names, "signal", 0, repairs);
  for (std::size_t k = 0; k < order.size(); ++k) header.signals[order[k]].label = names[k];
}

/// Notes units that cannot be read as they stand.
void state_units(const EdfHeader& header,
                 const std::vector<std::vector<std::size_t>>& clocks,
                 std::vector<Repair>& repairs) {
  std::map<std::string, std::vector<std::string>> odd;
  for (const auto& clock : clocks) {
    for (const std::size_t s : clock) {
      const EdfSignal& signal = header.signals[s];
      if (!signal.dimension.empty() && !parse_file_unit(signal.dimension))
        odd[signal.dimension].push_back(signal.label);
    }
  }
  for (const auto& [unit, names] : odd)
    note(repairs, "unit '{}' {}: {}", unit,
         unit_of_signal(unit) ? "read as uV, since a sign that cannot be read stands before the V"
                              : "is not known; the numbers are as in the file",
         fmt::join(names, ", "));
}

Scaled scaled_channels(const EdfHeader& header, const std::vector<std::size_t>& chosen) {
  Scaled scaled;
  for (const std::size_t s : chosen) {
    const EdfSignal& signal = header.signals[s];
    const auto unit = unit_of_signal(signal.dimension);
    const double to_si = unit ? unit->to_si : 1.0;
    const double gain = to_si * (signal.physical_max - signal.physical_min) / (signal.digital_max - signal.digital_min);
    scaled.scales.push_back({.scale = gain, .base = to_si * signal.physical_min - gain * signal.digital_min});
    scaled.has_unit.push_back(unit.has_value());
    scaled.channels.push_back({signal.label, unit ? unit->unit : Unit::dimensionless});
  }
  return scaled;
}

/// The begin of each record: from the header's length of a record or, in a recording with gaps,
/// from the time stamps in the annotations.
class RecordTimes {
 public:
  RecordTimes(const EdfHeader& header, double interval_s, const std::filesystem::path& path)
      : header_(header), interval_s_(interval_s), path_(path) {}

  /// Returns the begin of record `r` (counted from 0), whose time stamp is `onset`.
  double begin_s(std::int64_t r, const std::optional<double>& onset, std::vector<Repair>& repairs) {
    const double counted = static_cast<double>(r) * header_.record_s;
    if (onset && std::isnan(zero_s_)) zero_s_ = header_.gaps ? *onset : *onset - counted;
    if (header_.gaps) return stamped(r, onset, repairs);
    if (onset && stamps_agree_ && std::abs(*onset - zero_s_ - counted) > 0.5 * interval_s_ + 1e-6) {
      stamps_agree_ = false;
      note(repairs,
           "record {} says it begins {:.6g} s after the first, by the header's {} s for a "
           "record it is {:.6g} s, which is taken: compare the length of the recording",
           r + 1, *onset - zero_s_, header_.record_s, counted);
    }
    return counted;
  }

  /// Returns the time of the first sample on the clock of the stamps.
  [[nodiscard]] double zero_s() const { return std::isnan(zero_s_) ? 0.0 : zero_s_; }

 private:
  double stamped(std::int64_t r, const std::optional<double>& onset, std::vector<Repair>& repairs) {
    if (!onset) throw ReadError(path_, 0, "record {} does not say its time, as EDF+D must", r + 1);
    const double begin = *onset - zero_s_;
    const double expected = std::isnan(end_s_) ? begin : end_s_;
    if (begin < expected - 0.5 * interval_s_)
      throw ReadError(path_, 0, "record {} begins at {} s, before the one before it ends", r + 1, begin);
    if (begin > expected + 0.5 * interval_s_)
      note(repairs, "the recording pauses from {:.6g} s to {:.6g} s", expected, begin);
    end_s_ = begin + header_.record_s;
    return begin;
  }

  const EdfHeader& header_;
  double interval_s_;
  const std::filesystem::path& path_;
  double zero_s_ = kNan;  ///< NaN before the first stamp.
  double end_s_ = kNan;   ///< End of the previous record.
  bool stamps_agree_ = true;
};

/// Adds the events of a record and returns its time stamp.
std::optional<double> read_record_annotations(const EdfHeader& header,
                                              std::span<const std::byte> record,
                                              std::vector<Event>& events) {
  std::optional<double> onset;
  for (const EdfSignal& signal : header.signals) {
    if (!signal.annotations) continue;
    const auto* text = reinterpret_cast<const char*>(record.data() + signal.offset);
    const auto stamp = read_annotations({text, signal.per_record * header.sample_bytes}, events);
    if (!onset) onset = stamp;
  }
  return onset;
}

/// Returns true if the annotations of a record begin with the sign of its time stamp, or if there are none.
bool begins_with_stamp(const EdfHeader& header, std::span<const std::byte> record) {
  const auto annotations =
      std::ranges::find_if(header.signals, [](const EdfSignal& s) { return s.annotations && s.per_record > 0; });
  if (annotations == header.signals.end()) return true;
  const std::byte sign = record[annotations->offset];
  return sign == std::byte{'+'} || sign == std::byte{'-'};
}

/// The signals of one rate while they are read.
struct RateGroup {
  std::vector<std::size_t> signals;
  Scaled scaled;
  AnalogCounts counts;
};

RateGroup room_for_group(const EdfHeader& header, const std::vector<std::size_t>& signals, std::int64_t records) {
  RateGroup group{signals, scaled_channels(header, signals), {}};
  const auto per_record = static_cast<Eigen::Index>(header.signals[signals[0]].per_record);
  group.counts.scales = group.scaled.scales;
  group.counts.values = room_for(header, records * per_record, signals.size());
  group.counts.records =
      RecordClock{.per_record = per_record, .interval_s = header.record_s / static_cast<double>(per_record)};
  return group;
}

/// Puts the clock with the most EMG first and notes the clocks.
void take_groups(std::vector<RateGroup> groups, EdfFile& file, const std::filesystem::path& path) {
  std::vector<std::vector<Channel>> clocks;
  std::vector<double> rates;
  for (const RateGroup& group : groups) {
    clocks.push_back(group.scaled.channels);
    rates.push_back(1.0 / group.counts.records->interval_s);
  }
  const std::size_t first = first_clock(clocks);
  std::rotate(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(first),
              groups.begin() + static_cast<std::ptrdiff_t>(first) + 1);
  std::rotate(clocks.begin(), clocks.begin() + static_cast<std::ptrdiff_t>(first),
              clocks.begin() + static_cast<std::ptrdiff_t>(first) + 1);
  std::rotate(rates.begin(), rates.begin() + static_cast<std::ptrdiff_t>(first),
              rates.begin() + static_cast<std::ptrdiff_t>(first) + 1);
  if (groups.size() > 1) file.repairs.push_back({0, clocks_text(clocks, rates)});
  try {
    for (std::size_t g = 0; g < groups.size(); ++g) {
      EdfSignals signals{AnalogChannels(std::move(groups[g].scaled.channels), std::move(groups[g].counts)),
                         std::move(groups[g].scaled.has_unit)};
      if (g == 0)
        static_cast<EdfSignals&>(file) = std::move(signals);
      else
        file.other_clocks.push_back(std::move(signals));
    }
  } catch (const InvalidInput& error) {
    throw ReadError(path, 0, error.what());
  }
}

EdfFile read_edf_source(ByteSource& source, const std::filesystem::path& path) {
  EdfFile file;
  refuse_text_transfer(source, path);
  EdfHeader header = read_edf_header(source, path, file.repairs);
  refuse_returns(header, source, path);
  const std::int64_t records = record_count(header, source.size(), path, file.repairs);
  const auto clocks = signals_by_rate(header, file.repairs);
  if (clocks.empty()) throw ReadError(path, 0, "the file holds no signals with samples");
  if (!(header.record_s > 0.0))
    throw ReadError(path, 0, "byte 244: a record lasts {} s, so there is no rate", header.record_s);
  name_signals(header, clocks, file.repairs);
  state_units(header, clocks, file.repairs);
  std::vector<RateGroup> groups;
  for (const auto& clock : clocks) groups.push_back(room_for_group(header, clock, records));
  const bool odd_size = header.records != records || (source.size() - header.bytes) % header.record_bytes != 0;
  RecordTimes times(header, groups[0].counts.records->interval_s, path);
  for (std::int64_t r = 0; r < records; ++r) {
    const auto record = source.view(header.bytes + static_cast<std::uint64_t>(r) * header.record_bytes,
                                    static_cast<std::size_t>(header.record_bytes));
    const auto onset = read_record_annotations(header, record, file.events);
    if (odd_size && header.plus && !begins_with_stamp(header, record))
      throw ReadError(
          path, 0,
          "record {} does not begin with its time, and the size of the file is not as its header says: bytes "
          "are lost or inserted before it, as by a transfer as text; copy it again in binary mode",
          r + 1);
    const double begin_s = times.begin_s(r, onset, file.repairs);
    for (RateGroup& group : groups) {
      group.counts.records->begin_s.push_back(begin_s);
      take_samples(header, group.signals, record, r * group.counts.records->per_record, group.counts);
    }
  }
  if (const double zero_s = times.zero_s(); zero_s != 0.0) {
    for (Event& event : file.events) event.time_s -= zero_s;
    note(file.repairs,
         "the first record begins {:.6g} s after the header's start of the "
         "recording; here its first sample is at 0 s, and so count the events",
         zero_s);
  }
  take_groups(std::move(groups), file, path);
  return file;
}

}  // namespace

EdfFile read_edf(const std::filesystem::path& path) {
  ByteSource source(path);
  return read_edf_source(source, path);
}

EdfFile parse_edf(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  ByteSource source(bytes, path);
  return read_edf_source(source, path);
}

}  // namespace myoid::recording
