#include "myoid/recording/edf_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/core/numbers.h"
#include "myoid/files/byte_source.h"
#include "myoid/files/event.h"
#include "myoid/files/file_words.h"
#include "myoid/tables/table_layout.h"

namespace myoid::recording {
namespace {

constexpr std::size_t kHead = 256;

struct Signal {
  std::string label, dimension;
  double physical_min = 0.0, physical_max = 0.0, digital_min = 0.0, digital_max = 0.0;
  std::size_t per_record = 0;
  std::size_t offset = 0;  ///< Place of its samples in a record [bytes].
  bool annotations = false;
};

struct Header {
  bool bdf = false;
  bool gaps = false;  ///< EDF+D: each record states its own time.
  bool plus = false;
  std::size_t bytes = 0;
  std::int64_t records = -1;
  double record_s = 0.0;
  std::vector<Signal> signals;
  std::size_t sample_bytes = 2;
  std::uint64_t record_bytes = 0;
};

std::string field(std::span<const std::byte> bytes, std::size_t at, std::size_t length) {
  std::string text;
  for (const std::byte b : bytes.subspan(at, length)) text += static_cast<char>(b);
  return to_utf8(text.substr(0, text.find('\0')));
}

/// Reads a number of the header and notes a decimal comma.
std::optional<double> number(const std::string& text, std::vector<Repair>& repairs) {
  if (const auto value = parse_number(text)) return value;
  const auto value = parse_comma_number(text);
  if (value) note(repairs, "'{}' in the header read with a decimal comma", text);
  return value;
}

/// Reads the number in the header at this byte. Throws ReadError if the field holds none.
double required_number(std::span<const std::byte> head,
                       std::size_t at,
                       std::size_t length,
                       const char* what,
                       const std::filesystem::path& path,
                       std::vector<Repair>& repairs) {
  const std::string text = field(head, at, length);
  const auto value = number(text, repairs);
  if (!value) throw ReadError(path, 0, "byte {}: {}: expected a number, found '{}'", at, what, text);
  return *value;
}

/// Reads the fields of one signal. The header lists a field for all signals before the next field begins.
Signal read_signal(std::span<const std::byte> head,
                   std::size_t signals,
                   std::size_t s,
                   const std::filesystem::path& path,
                   std::vector<Repair>& repairs) {
  const auto of = [&](std::size_t before, std::size_t length) {
    return field(head, kHead + before * signals + length * s, length);
  };
  Signal signal;
  signal.label = of(0, 16);
  signal.annotations = signal.label == "EDF Annotations" || signal.label == "BDF Annotations";
  signal.dimension = of(96, 8);
  const auto value = [&](std::size_t before, const char* what) {
    const std::string text = of(before, 8);
    const auto v = number(text, repairs);
    if (!v || !std::isfinite(*v))
      throw ReadError(path, 0, "signal '{}': {}: expected a number, found '{}'", signal.label, what, text);
    return *v;
  };
  signal.physical_min = value(104, "physical minimum");
  signal.physical_max = value(112, "physical maximum");
  signal.digital_min = value(120, "digital minimum");
  signal.digital_max = value(128, "digital maximum");
  const double per_record = value(216, "samples in a record");
  if (!(per_record >= 0.0 && per_record <= 1e7) || per_record != std::floor(per_record))
    throw ReadError(path, 0, "signal '{}': {} samples in a record", signal.label, per_record);
  signal.per_record = static_cast<std::size_t>(per_record);
  return signal;
}

Header read_header(ByteSource& source, const std::filesystem::path& path, std::vector<Repair>& repairs) {
  if (source.size() < 2 * kHead)
    throw ReadError(path, 0, "the file has {} bytes, less than the header of one signal: it is cut off, or no EDF file",
                    source.size());
  Header header;
  const auto view = source.view(0, kHead);
  const std::vector<std::byte> head(view.begin(), view.end());
  header.bdf = head[0] == std::byte{0xFF};
  const std::string version = field(head, header.bdf ? 1 : 0, header.bdf ? 7 : 8);
  if (header.bdf ? version != "BIOSEMI" : version != "0") {
    throw ReadError(
        path, 0,

        "expected '0' (EDF) or 0xFF 'BIOSEMI' (BDF) in the first 8 bytes, found '{}'; this is another format", version);
  }
  header.sample_bytes = header.bdf ? 3 : 2;
  const std::string kind = field(head, 192, 44);
  header.plus = kind.starts_with("EDF+") || kind.starts_with("BDF+");
  header.gaps = kind.starts_with("EDF+D") || kind.starts_with("BDF+D");
  const double count = required_number(head, 252, 4, "number of signals", path, repairs);
  header.record_s = required_number(head, 244, 8, "duration of a record [s]", path, repairs);
  const double records = number(field(head, 236, 8), repairs).value_or(-1.0);
  header.records = std::abs(records) < 1e15 ? static_cast<std::int64_t>(records) : -1;
  if (!(count >= 1.0 && count <= 4096.0) || count != std::floor(count))
    throw ReadError(path, 0, "byte 252: {} signals; expected 1 to 4096", count);
  const auto signals = static_cast<std::size_t>(count);
  header.bytes = kHead * (signals + 1);
  if (source.size() < header.bytes)
    throw ReadError(path, 0, "{} signals need a header of {} bytes, the file has {}: it is cut off", signals,
                    header.bytes, source.size());
  if (const double said = required_number(head, 184, 8, "bytes of the header", path, repairs);
      said != static_cast<double>(header.bytes))
    note(repairs, "the header says it has {} bytes; with {} signals it has {}", said, signals, header.bytes);
  const auto rest = source.view(0, header.bytes);
  for (std::size_t s = 0; s < signals; ++s) {
    Signal signal = read_signal(rest, signals, s, path, repairs);
    signal.offset = static_cast<std::size_t>(header.record_bytes);
    header.record_bytes += signal.per_record * header.sample_bytes;
    header.signals.push_back(std::move(signal));
  }
  if (header.record_bytes == 0) throw ReadError(path, 0, "the signals have no samples");
  return header;
}

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

/// Returns the signals of one rate.
std::vector<std::size_t> choose(const Header& header, std::vector<Repair>& repairs) {
  std::map<std::size_t, std::vector<std::size_t>> by_rate;
  std::size_t best = 0;
  bool best_in_volts = false;
  std::vector<std::string> broken;
  for (std::size_t s = 0; s < header.signals.size(); ++s) {
    const Signal& signal = header.signals[s];
    if (signal.annotations || signal.per_record == 0) continue;
    if (signal.digital_min == signal.digital_max || signal.physical_min == signal.physical_max) {
      broken.push_back(signal.label);
      continue;
    }
    by_rate[signal.per_record].push_back(s);
    const auto unit = parse_file_unit(signal.dimension);
    const bool volts = unit && unit->unit == Unit::volt;
    if ((volts && !best_in_volts) || (volts == best_in_volts && signal.per_record > best)) {
      best = signal.per_record;
      best_in_volts = volts;
    }
  }
  if (!broken.empty())
    note(repairs, "signals left out, since their least and largest values are the same in the header: {}",
         fmt::join(broken, ", "));
  for (const auto& [per_record, list] : by_rate) {
    if (per_record == best) continue;
    note(repairs, "{} signals at {:.6g} Hz are left out, the first '{}'; those at {:.6g} Hz are taken", list.size(),
         static_cast<double>(per_record) / header.record_s, header.signals[list[0]].label,
         static_cast<double>(best) / header.record_s);
  }
  return by_rate[best];
}

/// Returns storage for the samples: 16-bit samples stay 16 bits; a 32-bit real holds 24 bits.
decltype(AnalogCounts::values) room_for(const Header& header, Eigen::Index rows, std::size_t signals) {
  const auto columns = static_cast<Eigen::Index>(signals);
  if (header.bdf) return AnalogCounts::Columns<float>(rows, columns);
  return AnalogCounts::Columns<std::int16_t>(rows, columns);
}

/// Copies the samples of the chosen signals in a record, from row `first` on.
void take_samples(const Header& header,
                  const std::vector<std::size_t>& chosen,
                  std::span<const std::byte> record,
                  Eigen::Index first,
                  AnalogCounts& counts) {
  std::visit(
      [&](auto& values) {
        using Count = typename std::decay_t<decltype(values)>::Scalar;
        for (std::size_t c = 0; c < chosen.size(); ++c) {
          const Signal& signal = header.signals[chosen[c]];
          const std::byte* p = record.data() + signal.offset;
          Count* out = &values(first, static_cast<Eigen::Index>(c));
          for (std::size_t i = 0; i < signal.per_record; ++i, p += header.sample_bytes)
            out[i] = static_cast<Count>(sample(p, header.bdf));
        }
      },
      counts.values);
}

/// Returns the number of records to read: the complete ones in the file, at most as many as the header states.
std::int64_t record_count(const Header& header,
                          std::uint64_t file_bytes,
                          const std::filesystem::path& path,
                          std::vector<Repair>& repairs) {
  const std::uint64_t available = file_bytes - header.bytes;
  auto records = static_cast<std::int64_t>(available / header.record_bytes);
  if (header.records >= 0 && header.records < records) {
    note(repairs, "the header says {} records, the file has {}; {} are taken", header.records, records, header.records);
    records = header.records;
  } else if (header.records != records || available % header.record_bytes != 0) {
    note(repairs, "the header says {} records, the file has {} whole ones, which are taken", header.records, records);
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

Scaled scaled_channels(const Header& header, const std::vector<std::size_t>& chosen, std::vector<Repair>& repairs) {
  std::vector<std::string> names;
  for (const std::size_t s : chosen) {
    const std::string& label = header.signals[s].label;
    names.push_back(label.empty() ? fmt::format("signal_{}", s + 1) : label);
  }
  names = unique_names(names, "signal", 0, repairs);
  Scaled scaled;
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const Signal& signal = header.signals[chosen[c]];
    const auto unit = parse_file_unit(signal.dimension);
    const double to_si = unit ? unit->to_si : 1.0;
    const double gain = to_si * (signal.physical_max - signal.physical_min) / (signal.digital_max - signal.digital_min);
    scaled.scales.push_back({.scale = gain, .base = to_si * signal.physical_min - gain * signal.digital_min});
    scaled.has_unit.push_back(unit.has_value());
    scaled.channels.push_back({names[c], unit ? unit->unit : Unit::dimensionless});
  }
  return scaled;
}

/// The begin of each record: from the header's length of a record or, in a recording with gaps,
/// from the time stamps in the annotations.
class RecordTimes {
 public:
  RecordTimes(const Header& header, double interval_s, const std::filesystem::path& path)
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

  const Header& header_;
  double interval_s_;
  const std::filesystem::path& path_;
  double zero_s_ = kNan;  ///< NaN before the first stamp.
  double end_s_ = kNan;   ///< End of the previous record.
  bool stamps_agree_ = true;
};

/// Adds the events of a record and returns its time stamp.
std::optional<double> read_record_annotations(const Header& header,
                                              std::span<const std::byte> record,
                                              std::vector<Event>& events) {
  std::optional<double> onset;
  for (const Signal& signal : header.signals) {
    if (!signal.annotations) continue;
    const auto* text = reinterpret_cast<const char*>(record.data() + signal.offset);
    const auto stamp = read_annotations({text, signal.per_record * header.sample_bytes}, events);
    if (!onset) onset = stamp;
  }
  return onset;
}

EdfFile read_edf_source(ByteSource& source, const std::filesystem::path& path) {
  EdfFile file;
  const Header header = read_header(source, path, file.repairs);
  const std::int64_t records = record_count(header, source.size(), path, file.repairs);
  const std::vector<std::size_t> chosen = choose(header, file.repairs);
  if (chosen.empty()) throw ReadError(path, 0, "the file holds no signals with samples");
  if (!(header.record_s > 0.0))
    throw ReadError(path, 0, "byte 244: a record lasts {} s, so there is no rate", header.record_s);
  Scaled scaled = scaled_channels(header, chosen, file.repairs);
  file.has_unit = std::move(scaled.has_unit);

  const auto per_record = static_cast<Eigen::Index>(header.signals[chosen[0]].per_record);
  const double dt = header.record_s / static_cast<double>(per_record);
  AnalogCounts counts;
  counts.scales = std::move(scaled.scales);
  counts.values = room_for(header, records * per_record, chosen.size());
  counts.records = RecordClock{.per_record = per_record, .interval_s = dt};
  RecordTimes times(header, dt, path);
  for (std::int64_t r = 0; r < records; ++r) {
    const auto record = source.view(header.bytes + static_cast<std::uint64_t>(r) * header.record_bytes,
                                    static_cast<std::size_t>(header.record_bytes));
    const auto onset = read_record_annotations(header, record, file.events);
    counts.records->begin_s.push_back(times.begin_s(r, onset, file.repairs));
    take_samples(header, chosen, record, r * per_record, counts);
  }
  if (const double zero_s = times.zero_s(); zero_s != 0.0) {
    for (Event& event : file.events) event.time_s -= zero_s;
    note(file.repairs,
         "the first record begins {:.6g} s after the header's start of the "
         "recording; here its first sample is at 0 s, and so count the events",
         zero_s);
  }
  try {
    file.data = AnalogChannels(std::move(scaled.channels), std::move(counts));
  } catch (const InvalidInput& error) {
    throw ReadError(path, 0, error.what());
  }
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
