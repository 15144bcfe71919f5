#include "myoid/recording/c3d_recording.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_signals.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/recording/plate_unit.h"
#include "myoid/recording/plate_zero.h"

namespace myoid::recording {
namespace {

/// What is read of a file. Notes on the parts that are read belong to them.
struct Parts {
  bool markers = true, analog = true;
  bool marker_notes = true, plate_notes = true;
};

/// Fills what the samples tell of the plates: their baselines and the units of their moments.
void judge_plates(const C3dHead& head, Recording& recording, std::vector<Repair>& repairs) {
  find_baselines(head.file, head.layout.frames, recording, repairs);
  for (PlateSetup& plate : recording.plates)
    mend_moment_unit(plate, recording.analog.as_written(plate.channels), repairs);
}

void append(std::vector<Repair>& repairs, const std::vector<Repair>& more) {
  repairs.insert(repairs.end(), more.begin(), more.end());
}

/// Reads the selected parts; the others stay empty. `head` keeps the file's statements without notes and events.
Recording read(const std::filesystem::path& path, const Parts& parts, C3dHead& head) {
  ByteSource source(path);
  head = read_c3d_head(source, path);
  Recording recording;
  recording.repairs = std::move(head.file.repairs);
  recording.events = std::move(head.file.events);
  recording.screen_up_L = screen_up(head.file);
  const C3dFrames frames = head.frames();
  const bool with_analog = parts.analog && !head.file.channels.empty();
  std::optional<C3dMarkerBuilder> markers;
  AnalogCounts counts;
  std::vector<Repair> of_plates, of_markers;
  try {
    if (with_analog) recording.plates = plate_setups(head.file, of_plates);
    if (parts.markers && !marker_columns(head.file).empty()) markers.emplace(head.file, head.layout.frames);
  } catch (const InvalidInput& error) {
    throw ReadError(path, 0, error.what());
  }
  if (with_analog) counts = frames.empty_counts();
  std::vector<float> points;
  frames.each_part(source, [&](std::int64_t first, std::int64_t count, const std::byte* bytes) {
    if (markers) {
      const std::size_t width = 4 * head.layout.points;
      points.resize(static_cast<std::size_t>(count) * width);
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
        frames.points(bytes + k * head.layout.frame_bytes(), points.data() + k * width);
      markers->add(first, count, points.data());
    }
    if (with_analog) frames.counts(bytes, first, count, counts);
  });
  if (markers) recording.markers = markers->finish(of_markers);
  if (with_analog) {
    C3dChannelUnits units = c3d_channel_units(head.file);
    counts.scales = std::move(units.scales);
    counts.first_sample = static_cast<double>(head.file.first_frame - 1) * head.file.analog_per_frame;
    counts.rate_hz = head.file.analog_rate_hz();
    recording.analog = AnalogChannels(std::move(units.channels), std::move(counts));
    if (parts.plate_notes) judge_plates(head, recording, of_plates);
  }
  if (parts.plate_notes) append(recording.repairs, of_plates);
  if (parts.marker_notes) append(recording.repairs, of_markers);
  return recording;
}

}  // namespace

Recording read_c3d_recording(const std::filesystem::path& path) {
  C3dHead head;
  return read(path, {}, head);
}

Recording read_c3d_plates(const std::filesystem::path& path) {
  C3dHead head;
  try {
    return read(path, {.marker_notes = false}, head);
  } catch (const ReadError&) {
    return read(path, {.markers = false, .marker_notes = false}, head);  // markers in no unit of length
  }
}

StatedBody stated_body(const C3dFile& file) {
  const auto within = [&](const char* name, double factor, double least, double most) -> std::optional<double> {
    const auto value = number_at(file.find("PROCESSING", name), 0);
    if (!value || factor * *value < least || factor * *value > most) return std::nullopt;
    return factor * *value;
  };
  return {within("BODYMASS", 1.0, 5.0, 300.0), within("HEIGHT", 1e-3, 0.4, 2.5)};
}

StatedBody read_stated_body(const std::filesystem::path& path) {
  if (format_of(path) != FileFormat::c3d) return {};
  ByteSource source(path);
  return stated_body(read_c3d_head(source, path).file);
}

Recording read_c3d_markers(const std::filesystem::path& path, std::string& unit) {
  C3dHead head;
  Recording recording = read(path, {.analog = false}, head);
  unit = head.file.point_unit;
  return recording;
}

Recording read_c3d_channels(const std::filesystem::path& path, std::vector<bool>& has_unit) {
  C3dHead head;
  // Notes about the plates do not concern a caller who reads only the channels.
  Recording recording = read(path, {.markers = false, .plate_notes = false}, head);
  for (const C3dChannel& channel : head.file.channels)
    has_unit.push_back(parse_file_unit(channel.unit_text).has_value());
  return recording;
}

}  // namespace myoid::recording
