#include "myoid/recording/c3d_recording.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "myoid/c3d/c3d_reader.h"
#include "myoid/c3d/c3d_signals.h"
#include "myoid/core/error.h"
#include "myoid/files/file_words.h"
#include "myoid/recording/laboratory_up.h"

namespace myoid::recording {
namespace {

/// Reads the selected parts; the others stay empty. `head` keeps the file's statements without notes and events.
Recording read(const std::filesystem::path& path, bool with_markers, bool with_analog, C3dHead& head) {
  ByteSource source(path);
  head = read_c3d_head(source, path);
  Recording recording;
  recording.repairs = std::move(head.file.repairs);
  recording.events = std::move(head.file.events);
  recording.screen_up_L = screen_up(head.file);
  const C3dFrames frames = head.frames();
  with_analog = with_analog && !head.file.channels.empty();
  std::optional<C3dMarkerBuilder> markers;
  AnalogCounts counts;
  try {
    // Notes about the plates do not concern a caller who reads only the channels.
    std::vector<Repair> unsaid;
    if (with_analog) recording.plates = plate_setups(head.file, with_markers ? recording.repairs : unsaid);
    if (with_markers && !marker_columns(head.file).empty()) markers.emplace(head.file, head.layout.frames);
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
  if (markers) recording.markers = markers->finish(recording.repairs);
  if (with_analog) {
    C3dChannelUnits units = c3d_channel_units(head.file);
    counts.scales = std::move(units.scales);
    counts.first_sample = static_cast<double>(head.file.first_frame - 1) * head.file.analog_per_frame;
    counts.rate_hz = head.file.analog_rate_hz();
    recording.analog = AnalogChannels(std::move(units.channels), std::move(counts));
  }
  return recording;
}

}  // namespace

Recording read_c3d_recording(const std::filesystem::path& path) {
  C3dHead head;
  return read(path, true, true, head);
}

Recording read_c3d_markers(const std::filesystem::path& path, std::string& unit) {
  C3dHead head;
  Recording recording = read(path, true, false, head);
  unit = head.file.point_unit;
  return recording;
}

Recording read_c3d_channels(const std::filesystem::path& path, std::vector<bool>& has_unit) {
  C3dHead head;
  Recording recording = read(path, false, true, head);
  for (const C3dChannel& channel : head.file.channels)
    has_unit.push_back(parse_file_unit(channel.unit_text).has_value());
  return recording;
}

}  // namespace myoid::recording
