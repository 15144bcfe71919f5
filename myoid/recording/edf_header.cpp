#include "myoid/recording/edf_header.h"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"

namespace myoid::recording {
namespace {

constexpr std::size_t kHead = 256;

std::string edf_field(std::span<const std::byte> bytes, std::size_t at, std::size_t length) {
  std::string text;
  for (const std::byte b : bytes.subspan(at, length)) text += static_cast<char>(b);
  return to_utf8(text.substr(0, text.find('\0')));
}

/// Reads a number of the header and notes a decimal comma.
std::optional<double> edf_number(const std::string& text, std::vector<Repair>& repairs) {
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
  const std::string text = edf_field(head, at, length);
  const auto value = edf_number(text, repairs);
  if (!value) throw ReadError(path, 0, "byte {}: {}: expected a number, found '{}'", at, what, text);
  return *value;
}

/// Reads the fields of one signal. The header lists a field for all signals before the next field begins.
EdfSignal read_edf_signal(std::span<const std::byte> head,
                          std::size_t signals,
                          std::size_t s,
                          const std::filesystem::path& path,
                          std::vector<Repair>& repairs) {
  const auto of = [&](std::size_t before, std::size_t length) {
    return edf_field(head, kHead + before * signals + length * s, length);
  };
  EdfSignal signal;
  signal.label = of(0, 16);
  signal.annotations = signal.label == "EDF Annotations" || signal.label == "BDF Annotations";
  signal.dimension = of(96, 8);
  const auto value = [&](std::size_t before, const char* what) {
    const std::string text = of(before, 8);
    const auto v = edf_number(text, repairs);
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

}  // namespace

EdfHeader read_edf_header(ByteSource& source, const std::filesystem::path& path, std::vector<Repair>& repairs) {
  if (source.size() < 2 * kHead)
    throw ReadError(path, 0, "the file has {} bytes, less than the header of one signal: it is cut off, or no EDF file",
                    source.size());
  EdfHeader header;
  const auto view = source.view(0, kHead);
  const std::vector<std::byte> head(view.begin(), view.end());
  header.bdf = head[0] == std::byte{0xFF};
  const std::string version = edf_field(head, header.bdf ? 1 : 0, header.bdf ? 7 : 8);
  if (header.bdf ? version != "BIOSEMI" : version != "0") {
    throw ReadError(
        path, 0,

        "expected '0' (EDF) or 0xFF 'BIOSEMI' (BDF) in the first 8 bytes, found '{}'; this is another format", version);
  }
  header.sample_bytes = header.bdf ? 3 : 2;
  const std::string kind = edf_field(head, 192, 44);
  header.plus = kind.starts_with("EDF+") || kind.starts_with("BDF+");
  header.gaps = kind.starts_with("EDF+D") || kind.starts_with("BDF+D");
  const double count = required_number(head, 252, 4, "number of signals", path, repairs);
  header.record_s = required_number(head, 244, 8, "duration of a record [s]", path, repairs);
  const double records = edf_number(edf_field(head, 236, 8), repairs).value_or(-1.0);
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
    EdfSignal signal = read_edf_signal(rest, signals, s, path, repairs);
    signal.offset = static_cast<std::size_t>(header.record_bytes);
    header.record_bytes += signal.per_record * header.sample_bytes;
    header.signals.push_back(std::move(signal));
  }
  if (header.record_bytes == 0) throw ReadError(path, 0, "the signals have no samples");
  return header;
}

}  // namespace myoid::recording
