#include "myoid/recording/c3d_writer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/c3d_bytes.h"
#include "myoid/recording/c3d_parameters.h"

namespace myoid::recording {
namespace {

constexpr std::size_t kBlock = 512;

C3dGroup& group_named(std::vector<C3dGroup>& groups, const std::string& name) {
  int largest = 0;
  for (C3dGroup& group : groups) {
    if (equal_ignoring_case(group.name, name)) return group;
    largest = std::max(largest, group.id);
  }
  C3dGroup group;
  group.id = largest + 1;
  group.name = name;
  groups.push_back(std::move(group));
  return groups.back();
}

void erase(C3dGroup& group, const std::string& name) {
  std::erase_if(group.parameters,
                [&](const C3dParameter& p) { return equal_ignoring_case(p.name, name); });
}

C3dParameter& parameter_named(C3dGroup& group, const std::string& name) {
  for (C3dParameter& p : group.parameters) {
    if (equal_ignoring_case(p.name, name)) return p;
  }
  C3dParameter parameter;
  parameter.name = name;
  group.parameters.push_back(std::move(parameter));
  return group.parameters.back();
}

void set_numbers(C3dGroup& group,
                 const std::string& name,
                 C3dType type,
                 std::vector<double> numbers,
                 std::vector<std::uint8_t> dimensions) {
  C3dParameter& p = parameter_named(group, name);
  p.type = type;
  p.numbers = std::move(numbers);
  p.dimensions = std::move(dimensions);
  p.text.clear();
}

void set_number(C3dGroup& group, const std::string& name, C3dType type, double value) {
  set_numbers(group, name, type, {value}, {});
}

void set_texts(C3dGroup& group,
               const std::string& name,
               const std::vector<std::string>& list,
               std::size_t first,
               std::size_t count,
               std::size_t width) {
  C3dParameter& p = parameter_named(group, name);
  p.type = C3dType::text;
  p.numbers.clear();
  p.dimensions = {static_cast<std::uint8_t>(width), static_cast<std::uint8_t>(count)};
  p.text.clear();
  for (std::size_t i = first; i < first + count; ++i) {
    p.text += list[i];
    p.text.append(width - list[i].size(), ' ');
  }
}

/// NAME, NAME2, ... for more than 255 elements or 65535 bytes; earlier ones of the name are
/// removed.
void set_long_texts(C3dGroup& group,
                    const std::string& name,
                    const std::vector<std::string>& list) {
  std::size_t width = 1;
  for (const std::string& text : list) width = std::max(width, text.size());
  if (width > 255)
    throw InvalidInput(fmt::format("C3D {}: a name of {} bytes; at most 255", name, width));
  const std::size_t most = std::min<std::size_t>(255, 65000 / width);
  for (int block = 1; block < 1000; ++block)
    erase(group, block == 1 ? name : fmt::format("{}{}", name, block));
  int block = 1;
  for (std::size_t first = 0; first < list.size() || block == 1; first += most, ++block) {
    set_texts(group, block == 1 ? name : fmt::format("{}{}", name, block), list, first,
              std::min(most, list.size() - first), width);
  }
}

void set_long_numbers(C3dGroup& group,
                      const std::string& name,
                      C3dType type,
                      const std::vector<double>& numbers) {
  for (int block = 1; block < 1000; ++block)
    erase(group, block == 1 ? name : fmt::format("{}{}", name, block));
  int block = 1;
  for (std::size_t first = 0; first < numbers.size() || block == 1; first += 255, ++block) {
    const std::size_t count = std::min<std::size_t>(255, numbers.size() - first);
    const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(first);
    set_numbers(group, block == 1 ? name : fmt::format("{}{}", name, block), type,
                {begin, begin + static_cast<std::ptrdiff_t>(count)},
                {static_cast<std::uint8_t>(count)});
  }
}

void describe_points(std::vector<C3dGroup>& groups, const C3dFile& file, double scale) {
  C3dGroup& group = group_named(groups, "POINT");
  const auto frames = static_cast<double>(file.frame_count());
  set_number(group, "USED", C3dType::integer, static_cast<double>(file.point_labels.size()));
  set_number(group, "FRAMES", C3dType::integer, std::min(frames, 65535.0));
  set_number(group, "DATA_START", C3dType::integer, 0.0);
  set_number(group, "SCALE", C3dType::real, scale);
  set_number(group, "RATE", C3dType::real, file.point_rate_hz);
  set_long_texts(group, "LABELS", file.point_labels);
  const bool described = std::any_of(
      group.parameters.begin(), group.parameters.end(),
      [](const C3dParameter& p) { return equal_ignoring_case(p.name, "DESCRIPTIONS"); });
  if (!described)
    set_long_texts(group, "DESCRIPTIONS", std::vector<std::string>(file.point_labels.size(), " "));
  set_texts(group, "UNITS", {file.point_unit.empty() ? "mm" : file.point_unit}, 0, 1,
            std::max<std::size_t>(1, file.point_unit.empty() ? 2 : file.point_unit.size()));
  const std::int64_t last = file.first_frame + file.frame_count() - 1;
  erase(group, "LONG_FRAMES");
  if (frames > 65535.0) set_number(group, "LONG_FRAMES", C3dType::real, frames);
  if (last > 65535 || file.find("TRIAL", "ACTUAL_START_FIELD") != nullptr) {
    C3dGroup& trial = group_named(groups, "TRIAL");
    const auto words = [](std::int64_t value) {
      return std::vector<double>{static_cast<double>(value % 65536),
                                 static_cast<double>(value / 65536)};
    };
    set_numbers(trial, "ACTUAL_START_FIELD", C3dType::integer, words(file.first_frame), {2});
    set_numbers(trial, "ACTUAL_END_FIELD", C3dType::integer, words(last), {2});
  }
}

void describe_channels(std::vector<C3dGroup>& groups, const C3dFile& file) {
  C3dGroup& group = group_named(groups, "ANALOG");
  const std::size_t count = file.channels.size();
  set_number(group, "USED", C3dType::integer, static_cast<double>(count));
  set_number(group, "RATE", C3dType::real, file.analog_rate_hz());
  std::vector<std::string> names;
  std::vector<std::string> units;
  std::vector<double> scales;
  std::vector<double> offsets;
  // SCALE is what is left of the factor without GEN_SCALE, and exact if the file came from one.
  const double general = number_at(file.find("ANALOG", "GEN_SCALE"), 0).value_or(1.0);
  const double divide = general != 0.0 ? general : 1.0;
  bool is_unsigned = false;
  for (const C3dChannel& channel : file.channels) {
    names.push_back(channel.name);
    units.push_back(channel.unit_text);
    const auto scale = static_cast<float>(channel.scale / divide);
    if (static_cast<double>(scale) * divide != channel.scale && !std::isnan(channel.scale)) {
      throw InvalidInput(fmt::format("C3D channel '{}': the scale {} does not fit into 32 bits",
                                     channel.name, channel.scale));
    }
    scales.push_back(static_cast<double>(scale));
    offsets.push_back(channel.offset);
    if (channel.offset > 32767.0) is_unsigned = true;
  }
  erase(group, "OFFSETS");
  const C3dParameter* said = file.find("ANALOG", "FORMAT");
  if (is_unsigned) {
    set_texts(group, "FORMAT", {"UNSIGNED"}, 0, 1, 8);
  } else if (said != nullptr && !texts(*said).empty() &&
             equal_ignoring_case(texts(*said)[0], "UNSIGNED") &&
             std::any_of(offsets.begin(), offsets.end(), [](double o) { return o < 0.0; })) {
    set_texts(group, "FORMAT", {"SIGNED"}, 0, 1, 6);
  }
  set_number(group, "GEN_SCALE", C3dType::real, divide);
  set_long_numbers(group, "SCALE", C3dType::real, scales);
  set_long_numbers(group, "OFFSET", C3dType::integer, offsets);
  set_long_texts(group, "LABELS", names);
  set_long_texts(group, "UNITS", units);
  if (file.find("ANALOG", "DESCRIPTIONS") == nullptr)
    set_long_texts(group, "DESCRIPTIONS", std::vector<std::string>(count, " "));
}

void describe_events(std::vector<C3dGroup>& groups, const C3dFile& file) {
  if (file.events.empty() && file.find("EVENT", "USED") == nullptr) return;
  C3dGroup& group = group_named(groups, "EVENT");
  if (file.events.size() > 255)
    throw InvalidInput(fmt::format("{} events; a C3D file holds at most 255", file.events.size()));
  std::vector<std::string> labels;
  std::vector<std::string> contexts;
  std::vector<std::string> subjects;
  std::vector<double> times;
  for (const C3dEvent& event : file.events) {
    labels.push_back(event.label);
    contexts.push_back(event.context);
    subjects.push_back(event.subject);
    times.push_back(0.0);
    times.push_back(event.time_s);
  }
  const auto count = static_cast<std::uint8_t>(file.events.size());
  set_number(group, "USED", C3dType::integer, count);
  set_numbers(group, "TIMES", C3dType::real, std::move(times), {2, count});
  set_long_texts(group, "LABELS", labels);
  set_long_texts(group, "CONTEXTS", contexts);
  set_long_texts(group, "SUBJECTS", subjects);
}

/// The groups of the file with everything in them that describes the data as they are written.
std::vector<C3dGroup> groups_of(const C3dFile& file, double scale) {
  std::vector<C3dGroup> groups = file.groups;
  for (C3dGroup& group : groups) {
    if (equal_ignoring_case(group.name, "FORCE_PLATEFORM")) group.name = "FORCE_PLATFORM";
  }
  describe_points(groups, file, scale);
  describe_channels(groups, file);
  C3dGroup& plates = group_named(groups, "FORCE_PLATFORM");
  if (std::none_of(plates.parameters.begin(), plates.parameters.end(),
                   [](const C3dParameter& p) { return equal_ignoring_case(p.name, "USED"); })) {
    set_number(plates, "USED", C3dType::integer, 0.0);
    set_numbers(plates, "TYPE", C3dType::integer, {}, {0});
    set_numbers(plates, "ZERO", C3dType::integer, {1.0, 0.0}, {2});
    set_numbers(plates, "CORNERS", C3dType::real, {}, {3, 4, 0});
    set_numbers(plates, "ORIGIN", C3dType::real, {}, {3, 0});
    set_numbers(plates, "CHANNEL", C3dType::integer, {}, {6, 0});
  }
  describe_events(groups, file);
  return groups;
}

std::int16_t whole(double value, bool is_unsigned, const std::string& what) {
  const double low = is_unsigned ? 0.0 : -32768.0;
  const double high = is_unsigned ? 65535.0 : 32767.0;
  if (!(value >= low && value <= high) || value != std::nearbyint(value)) {
    throw InvalidInput(fmt::format(
        "{}: {} is not a whole number from {} to {}; write reals instead", what, value, low, high));
  }
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(static_cast<int>(value)));
}

/// The data of one frame behind each other.
class SampleWriter {
 public:
  SampleWriter(std::byte* at, const C3dFile& file, const C3dFormat& format, bool is_unsigned)
      : at_(at),
        number_{format.processor},
        integer_(format.integer),
        is_unsigned_(is_unsigned),
        scale_(static_cast<double>(file.point_scale)) {}

  void point(const float* p) {
    const bool measured = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    const float fourth = !measured || std::isnan(p[3]) ? -1.0F : p[3];
    for (int axis = 0; axis < 3; ++axis) {
      const float value = measured ? p[axis] : 0.0F;
      if (integer_) {
        put(whole(std::nearbyint(static_cast<double>(value) / scale_), false, "C3D coordinate"));
      } else {
        put(value, "C3D coordinate");
      }
    }
    if (integer_) {
      put(whole(static_cast<double>(fourth), false, "C3D residual"));
    } else {
      put(fourth, "C3D residual");
    }
  }

  void sample(float value) {
    if (integer_) {
      put(whole(static_cast<double>(value), is_unsigned_, "C3D analog sample"));
    } else {
      put(value, "C3D analog sample");
    }
  }

 private:
  void put(std::int16_t value) {
    number_.put_u16(at_, static_cast<std::uint16_t>(value));
    at_ += 2;
  }
  void put(float value, const char* what) {
    if (!number_.put_real(at_, value))
      throw InvalidInput(fmt::format("{}: {} cannot be written as a DEC number", what, value));
    at_ += 4;
  }

  std::byte* at_;
  C3dBytes number_;
  bool integer_;
  bool is_unsigned_;
  double scale_;
};

}  // namespace

std::vector<std::byte> format_c3d(const C3dFile& file, const C3dFormat& format) {
  const std::size_t points = file.point_labels.size();
  const std::size_t analog = file.channels.size() * static_cast<std::size_t>(file.analog_per_frame);
  const auto frames = static_cast<std::size_t>(file.frame_count());
  if (points > 65535 || analog > 65535)
    throw InvalidInput(fmt::format(
        "{} points and {} analog samples a frame; a C3D file holds at most 65535", points, analog));
  if (frames == 0 || points + analog == 0)
    throw InvalidInput("a C3D file needs at least one frame of points or analog samples");
  const double scale = static_cast<double>(file.point_scale) * (format.integer ? 1.0 : -1.0);
  const C3dBytes number{format.processor};

  // Parameters: once to know their length, then with the block at which the data begin.
  std::vector<C3dGroup> groups = groups_of(file, scale);
  std::vector<std::byte> section = format_c3d_parameters(groups, number);
  const std::size_t data_block = 2 + section.size() / kBlock;
  set_number(group_named(groups, "POINT"), "DATA_START", C3dType::integer,
             static_cast<double>(data_block));
  section = format_c3d_parameters(groups, number);

  const std::size_t data = (data_block - 1) * kBlock;
  const std::size_t frame_bytes = (4 * points + analog) * (format.integer ? 2 : 4);
  const std::size_t size = data + frames * frame_bytes;
  std::vector<std::byte> out((size + kBlock - 1) / kBlock * kBlock);

  // Header.
  const auto word = [&](std::size_t n, std::size_t value) {
    number.put_u16(&out[2 * (n - 1)], static_cast<std::uint16_t>(value));
  };
  const auto real = [&](std::size_t n, double value) {
    if (!number.put_real(&out[2 * (n - 1)], static_cast<float>(value)))
      throw InvalidInput(fmt::format("C3D header: {} cannot be written", value));
  };
  out[0] = std::byte{2};
  out[1] = std::byte{0x50};
  word(2, points);
  word(3, analog);
  const std::int64_t last = file.first_frame + file.frame_count() - 1;
  word(4, static_cast<std::size_t>(std::clamp<std::int64_t>(file.first_frame, 0, 65535)));
  word(5, static_cast<std::size_t>(std::clamp<std::int64_t>(last, 0, 65535)));
  word(6, 10);
  real(7, scale);
  word(9, data_block);
  word(10, static_cast<std::size_t>(file.channels.empty() ? 1 : file.analog_per_frame));
  real(11, file.point_rate_hz);
  word(150, 12345);
  std::copy(section.begin(), section.end(), out.begin() + kBlock);

  // Samples.
  bool is_unsigned = false;
  for (const C3dChannel& channel : file.channels)
    is_unsigned = is_unsigned || channel.offset > 32767;
  if (const C3dParameter* said = file.find("ANALOG", "FORMAT");
      said != nullptr && !texts(*said).empty() && equal_ignoring_case(texts(*said)[0], "UNSIGNED"))
    is_unsigned = std::none_of(file.channels.begin(), file.channels.end(),
                               [](const C3dChannel& c) { return c.offset < 0.0; });
  SampleWriter writer(&out[data], file, format, is_unsigned);
  for (Eigen::Index k = 0; k < file.frame_count(); ++k) {
    for (Eigen::Index p = 0; p < static_cast<Eigen::Index>(points); ++p)
      writer.point(&file.points(k, 4 * p));
    for (Eigen::Index i = 0; i < (file.channels.empty() ? 0 : file.analog_per_frame); ++i) {
      for (Eigen::Index c = 0; c < file.analog.cols(); ++c)
        writer.sample(file.analog(k * file.analog_per_frame + i, c));
    }
  }
  return out;
}

void write_c3d(const std::filesystem::path& path, const C3dFile& file, const C3dFormat& format) {
  const std::vector<std::byte> bytes = format_c3d(file, format);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

C3dFile make_c3d(const MarkerSeries& markers, const TimeSeries& analog) {
  if (markers.frame_count() == 0 && analog.empty())
    throw InvalidInput("a C3D file needs markers or analog channels");
  C3dFile file;
  file.point_unit = "mm";
  const auto rate_of = [](const Eigen::VectorXd& time_s, const char* what) {
    const Eigen::Index n = time_s.size();
    if (n < 2) throw InvalidInput(fmt::format("{}: a C3D file needs at least two samples", what));
    const double dt = (time_s[n - 1] - time_s[0]) / static_cast<double>(n - 1);
    for (Eigen::Index i = 1; i < n; ++i) {
      if (std::abs(time_s[i] - time_s[0] - static_cast<double>(i) * dt) > 0.05 * dt)
        throw InvalidInput(
            fmt::format("{}: the samples are not evenly spaced ({} s to {} s), as a C3D file needs "
                        "them; resample first",
                        what, time_s[i - 1], time_s[i]));
    }
    // Rates are whole or have few decimals; times were rounded when they were written.
    const double rate = 1.0 / dt;
    const double rounded = std::round(rate * 100.0) / 100.0;
    return std::abs(rate - rounded) < 1e-4 * rate ? rounded : rate;
  };
  const bool has_markers = markers.frame_count() > 0;
  const Eigen::VectorXd& clock = has_markers ? markers.time_s : analog.time_s();
  file.point_rate_hz = rate_of(clock, has_markers ? "markers" : "analog");
  file.first_frame = 1 + std::llround(clock[0] * file.point_rate_hz);
  file.point_labels = markers.names;
  Eigen::Index frames = clock.size();
  if (!analog.empty()) {
    const double ratio = rate_of(analog.time_s(), "analog") / file.point_rate_hz;
    file.analog_per_frame = static_cast<int>(std::lround(ratio));
    if (file.analog_per_frame < 1 || std::abs(ratio - file.analog_per_frame) > 1e-3 * ratio) {
      throw InvalidInput(
          fmt::format("{} analog samples for each frame: a C3D file needs a whole number; resample "
                      "the analog channels to a multiple of {} Hz",
                      ratio, file.point_rate_hz));
    }
    const double lag = analog.time_s()[0] - clock[0];
    if (std::abs(lag) * ratio * file.point_rate_hz > 0.5) {
      throw InvalidInput(
          fmt::format("markers begin at {} s, analog channels at {} s; a C3D file "
                      "needs one beginning: cut the longer one",
                      clock[0], analog.time_s()[0]));
    }
    frames = std::min(frames, analog.sample_count() / file.analog_per_frame);
    if (frames == 0) throw InvalidInput("the analog channels are shorter than one frame");
  }
  file.points.resize(frames, 4 * markers.marker_count());
  for (Eigen::Index k = 0; k < frames; ++k) {
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      const bool gap = markers.missing(k, m);
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        file.points(k, 4 * m + axis) =
            gap ? 0.0F : static_cast<float>(1000.0 * markers.positions_m(k, 3 * m + axis));
      file.points(k, 4 * m + 3) = gap ? -1.0F : 0.0F;
    }
  }
  const Eigen::Index samples = analog.empty() ? 0 : frames * file.analog_per_frame;
  file.analog.resize(samples, analog.channel_count());
  for (Eigen::Index c = 0; c < analog.channel_count(); ++c) {
    const Channel& channel = analog.channels()[static_cast<std::size_t>(c)];
    const bool moment = channel.unit == Unit::newton_meter;
    file.channels.push_back({channel.name,
                             moment ? "Nmm"
                             : channel.unit == Unit::dimensionless
                                 ? ""
                                 : std::string(symbol(channel.unit)),
                             0.0, 1.0});
    for (Eigen::Index i = 0; i < samples; ++i)
      file.analog(i, c) = static_cast<float>(analog.values()(i, c) * (moment ? 1000.0 : 1.0));
  }
  return file;
}

}  // namespace myoid::recording
