#include "myoid/recording/c3d/c3d_description.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

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
  std::erase_if(group.parameters, [&](const C3dParameter& p) { return equal_ignoring_case(p.name, name); });
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

/// Splits more than 255 elements or 65535 bytes over NAME, NAME2, ...; earlier parameters of these names are removed.
void set_long_texts(C3dGroup& group, const std::string& name, const std::vector<std::string>& list) {
  std::size_t width = 1;
  for (const std::string& text : list) width = std::max(width, text.size());
  if (width > 255) throw InvalidInput("C3D {}: a name of {} bytes; at most 255", name, width);
  const std::size_t most = std::min<std::size_t>(255, 65000 / width);
  for (int block = 1; block < 1000; ++block) erase(group, block_name(name, block));
  int block = 1;
  for (std::size_t first = 0; first < list.size() || block == 1; first += most, ++block) {
    set_texts(group, block_name(name, block), list, first, std::min(most, list.size() - first), width);
  }
}

/// Splits numbers over NAME, NAME2, ... likewise; each element has `rows` numbers.
void set_long_numbers(
    C3dGroup& group, const std::string& name, C3dType type, const std::vector<double>& numbers, std::uint8_t rows = 1) {
  for (int block = 1; block < 1000; ++block) erase(group, block_name(name, block));
  int block = 1;
  const std::size_t elements = numbers.size() / rows;
  for (std::size_t first = 0; first < elements || block == 1; first += 255, ++block) {
    const std::size_t count = std::min<std::size_t>(255, elements - first);
    const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(first * rows);
    std::vector<std::uint8_t> dimensions{static_cast<std::uint8_t>(count)};
    if (rows > 1) dimensions.insert(dimensions.begin(), rows);
    set_numbers(group, block_name(name, block), type, {begin, begin + static_cast<std::ptrdiff_t>(count * rows)},
                std::move(dimensions));
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
  const bool described = std::any_of(group.parameters.begin(), group.parameters.end(),
                                     [](const C3dParameter& p) { return equal_ignoring_case(p.name, "DESCRIPTIONS"); });
  if (!described) set_long_texts(group, "DESCRIPTIONS", std::vector<std::string>(file.point_labels.size(), " "));
  set_texts(group, "UNITS", {file.point_unit.empty() ? "mm" : file.point_unit}, 0, 1,
            std::max<std::size_t>(1, file.point_unit.empty() ? 2 : file.point_unit.size()));
  const std::int64_t last = file.first_frame + file.frame_count() - 1;
  erase(group, "LONG_FRAMES");
  if (frames > 65535.0) set_number(group, "LONG_FRAMES", C3dType::real, frames);
  if (last > 65535 || file.find("TRIAL", "ACTUAL_START_FIELD") != nullptr) {
    C3dGroup& trial = group_named(groups, "TRIAL");
    const auto words = [](std::int64_t value) {
      return std::vector<double>{static_cast<double>(value % 65536), static_cast<double>(value / 65536)};
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
  // SCALE is the channel's factor divided by GEN_SCALE; for a channel of a C3D file it is exact.
  const double general = number_at(file.find("ANALOG", "GEN_SCALE"), 0).value_or(1.0);
  const double divide = general != 0.0 ? general : 1.0;
  bool is_unsigned = false;
  for (const C3dChannel& channel : file.channels) {
    names.push_back(channel.name);
    units.push_back(channel.unit_text);
    const auto scale = static_cast<float>(channel.scale / divide);
    if (static_cast<double>(scale) * divide != channel.scale && !std::isnan(channel.scale)) {
      throw InvalidInput("C3D channel '{}': the scale {} does not fit into 32 bits", channel.name, channel.scale);
    }
    scales.push_back(static_cast<double>(scale));
    offsets.push_back(channel.offset);
    if (channel.offset > 32767.0) is_unsigned = true;
  }
  erase(group, "OFFSETS");
  if (is_unsigned) {
    set_texts(group, "FORMAT", {"UNSIGNED"}, 0, 1, 8);
  } else if (file.says_unsigned() && std::any_of(offsets.begin(), offsets.end(), [](double o) { return o < 0.0; })) {
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
  constexpr std::size_t kMost = 65535;  // USED has 16 bits
  if (file.events.size() > kMost)
    throw InvalidInput("{} events; a C3D file holds at most {}", file.events.size(), kMost);
  std::vector<std::string> labels;
  std::vector<std::string> contexts;
  std::vector<std::string> subjects;
  std::vector<double> times;
  for (const Event& event : file.events) {
    labels.push_back(event.label);
    contexts.push_back(event.context);
    subjects.push_back(event.subject);
    times.push_back(0.0);
    times.push_back(event.time_s);
  }
  set_number(group, "USED", C3dType::integer, static_cast<double>(file.events.size()));
  set_long_numbers(group, "TIMES", C3dType::real, times, 2);
  set_long_texts(group, "LABELS", labels);
  set_long_texts(group, "CONTEXTS", contexts);
  set_long_texts(group, "SUBJECTS", subjects);
}

}  // namespace

std::vector<C3dGroup> c3d_description(const C3dFile& file, double scale) {
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

void set_data_start(std::vector<C3dGroup>& groups, std::size_t block) {
  set_number(group_named(groups, "POINT"), "DATA_START", C3dType::integer, static_cast<double>(block));
}

}  // namespace myoid::recording
