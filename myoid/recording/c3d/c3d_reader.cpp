#include "myoid/recording/c3d/c3d_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/unique_names.h"
#include "myoid/recording/c3d/c3d_bytes.h"
#include "myoid/recording/c3d/c3d_events.h"
#include "myoid/recording/c3d/c3d_frames.h"
#include "myoid/recording/c3d/c3d_parameters.h"

namespace myoid::recording {
namespace {

/// Returns `count` names, none empty, all unique.
std::vector<std::string> unique_names(std::vector<std::string> names,
                                      std::size_t count,
                                      std::string_view parameter,
                                      std::string_view stem,
                                      std::vector<Repair>& repairs) {
  const std::size_t given = std::min(names.size(), count);
  names.resize(count);
  std::size_t empty = 0;
  std::vector<std::string> renamed;
  UniqueNames unique({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(given)});
  for (std::size_t i = 0; i < count; ++i) {
    if (names[i].empty()) {
      names[i] = fmt::format("{}_{}", stem, i + 1);
      ++empty;
    }
    std::string name = unique.take(names[i]);
    if (name != names[i]) renamed.push_back(name);
    names[i] = std::move(name);
  }
  if (given < count) {
    note(repairs, "{} has {} names for {} columns; the others are called '{}_{}' and so on", parameter, given, count,
         stem, given + 1);
  } else if (empty > 0) {
    note(repairs, "{}: {} names are empty; called '{}_N' by their place", parameter, empty, stem);
  }
  if (!renamed.empty()) {
    const std::size_t shown = std::min<std::size_t>(renamed.size(), 8);
    note(repairs, "{}: {} names stand twice; the later ones are called {}{}", parameter, renamed.size(),
         fmt::join(renamed.begin(), renamed.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
         shown < renamed.size() ? ", ..." : "");
  }
  return names;
}

void read_channels(C3dFile& file, const C3dLayout& layout) {
  const std::size_t count = layout.channels;
  if (count == 0) return;
  const auto names = unique_names(all_texts(file, "ANALOG", "LABELS"), count, "ANALOG:LABELS", "analog", file.repairs);
  const auto units = all_texts(file, "ANALOG", "UNITS");
  const auto scales = all_numbers(file, "ANALOG", "SCALE");
  auto offsets = all_numbers(file, "ANALOG", "OFFSET");
  auto general = number_at(file.find("ANALOG", "GEN_SCALE"), 0);
  const auto few = [&](std::string_view name, std::size_t have, std::string_view instead) {
    if (have < count)
      note(file.repairs, "ANALOG:{} has {} values for {} channels; {} for the others", name, have, count, instead);
  };
  few("UNITS", units.size(), "no unit is assumed");
  few("SCALE", scales.size(), "1 is assumed");
  few("OFFSET", offsets.size(), "0 is assumed");
  if (!general) {
    note(file.repairs, "ANALOG:GEN_SCALE is missing; 1 is assumed");
    general = 1.0;
  }
  if (file.says_unsigned()) {
    for (double& offset : offsets) offset += offset < 0.0 ? 65536.0 : 0.0;
  }
  std::vector<std::string> zero;
  for (std::size_t c = 0; c < count; ++c) {
    C3dChannel channel;
    channel.name = names[c];
    if (c < units.size()) channel.unit_text = units[c];
    if (c < offsets.size()) channel.offset = offsets[c];
    channel.scale = *general * (c < scales.size() ? scales[c] : 1.0);
    if (!std::isfinite(channel.scale) || !std::isfinite(channel.offset)) {
      note(file.repairs, "channel '{}': scale or offset is not a number; its samples are left as gaps", channel.name);
      channel.scale = std::nan("");
      channel.offset = 0.0;
    }
    if (channel.scale == 0.0) zero.push_back(channel.name);
    file.channels.push_back(std::move(channel));
  }
  if (zero.empty()) return;
  const std::size_t shown = std::min<std::size_t>(zero.size(), 8);
  note(file.repairs, "ANALOG:{} is 0 for {} of {} channels, which read 0 in every sample: {}{}",
       *general == 0.0 ? "GEN_SCALE" : "SCALE", zero.size(), count,
       fmt::join(zero.begin(), zero.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
       shown < zero.size() ? ", ..." : "");
}

/// Returns the usual distance between the points of a frame along an axis, in the file's unit: the
/// median of frames spread over the whole file. 0 where no frame has two points.
double usual_extent(const C3dFrames& frames, const C3dLayout& layout, ByteSource& source) {
  constexpr std::int64_t kFrames = 25;
  const std::int64_t count = std::min(kFrames, layout.frames);
  std::vector<float> points(4 * layout.points);
  std::vector<double> extents;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t frame = k * layout.frames / count;
    const auto bytes = source.view(layout.data_offset + static_cast<std::uint64_t>(frame) * layout.frame_bytes(),
                                   layout.frame_bytes());
    frames.points(bytes.data(), points.data());
    double extent = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float low = INFINITY, high = -INFINITY;
      for (std::size_t m = 0; m < layout.points; ++m) {
        const float x = points[4 * m + axis];
        if (!(points[4 * m + 3] >= 0.0F) || !std::isfinite(x) || x == 0.0F) continue;
        low = std::min(low, x);
        high = std::max(high, x);
      }
      if (low < high) extent = std::max(extent, static_cast<double>(high - low));
    }
    extents.push_back(extent);
  }
  std::sort(extents.begin(), extents.end());
  return extents.empty() ? 0.0 : extents[extents.size() / 2];
}

/// Returns the unit of length whose English word begins with this text of at least two letters
/// ("millim", "mete"), since a short field cuts the word. Empty if there is none.
std::optional<std::string> length_unit_of_prefix(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, const char*>, 6> kWords{{{"millimeters", "mm"},
                                                                            {"millimetres", "mm"},
                                                                            {"centimeters", "cm"},
                                                                            {"centimetres", "cm"},
                                                                            {"meters", "m"},
                                                                            {"metres", "m"}}};
  const std::string clean = to_utf8(text.substr(0, text.find('\0')));
  if (clean.size() < 2) return std::nullopt;
  for (const auto& [word, unit] : kWords) {
    if (equal_ignoring_case(word.substr(0, clean.size()), clean)) return unit;
  }
  return std::nullopt;
}

/// Reads POINT:UNITS and completes a word that its field cuts short. "m" may be a cut "mm": then
/// the points of a frame seem farther apart than a laboratory is long.
void read_point_unit(C3dFile& file, const C3dFrames& frames, const C3dLayout& layout, ByteSource& source) {
  constexpr double kLongest_m = 50.0;
  if (const C3dParameter* unit = file.find("POINT", "UNITS"); unit != nullptr && !texts(*unit).empty())
    file.point_unit = texts(*unit)[0];
  const auto take = [&](const std::string& unit, const std::string& note) {
    file.point_unit = unit;
    if (layout.points > 0) file.repairs.push_back({0, note});
  };
  if (file.point_unit.empty()) {
    take("mm", "POINT:UNITS is missing; mm is assumed: compare a known distance");
  } else if (!parse_file_unit(file.point_unit)) {
    if (const auto whole = length_unit_of_prefix(file.point_unit))
      take(*whole, fmt::format("POINT:UNITS '{}' is a word cut short; read as {}", file.point_unit, *whole));
  } else if (equal_ignoring_case(file.point_unit, "m")) {
    const double extent = usual_extent(frames, layout, source);
    if (extent > kLongest_m)
      take("mm", fmt::format("POINT:UNITS says m, and the points of a frame would lie {:.4g} m apart; read as mm, cut "
                             "short: compare a known distance",
                             extent));
  }
}

void read_rates(C3dFile& file, const C3dHeader& header, const C3dLayout& layout, const std::filesystem::path& path) {
  const double said = number_at(file.find("POINT", "RATE"), 0).value_or(0.0);
  const double analog = number_at(file.find("ANALOG", "RATE"), 0).value_or(0.0);
  const auto in_header = static_cast<double>(header.rate_hz);
  const auto ratio = static_cast<double>(layout.analog_per_frame);
  file.point_rate_hz = is_c3d_rate(said) ? said : in_header;
  const auto contradict = [&](double one_hz, double other_hz, std::string says) {
    const auto frames = static_cast<double>(layout.frames);
    file.repairs.push_back({0, std::move(says), std::abs(frames / one_hz - frames / other_hz)});
  };
  if (!is_c3d_rate(file.point_rate_hz)) {
    if (layout.channels == 0 || !is_c3d_rate(analog)) {
      throw ReadError(path, 0, "the frame rate is {} in the header and {} in POINT:RATE; correct one of them",
                      in_header, said);
    }
    file.point_rate_hz = analog / ratio;
    note(file.repairs, "no frame rate; taken as {} Hz from ANALOG:RATE", file.point_rate_hz);
  } else if (is_c3d_rate(said) && is_c3d_rate(in_header) && std::abs(said - in_header) > 1e-3 * said) {
    const bool as_header = layout.channels > 0 && std::abs(analog - in_header * ratio) < 1e-3 * analog;
    if (as_header) file.point_rate_hz = in_header;
    contradict(said, in_header,
               fmt::format("the frame rate is {} Hz in POINT:RATE and {} Hz in the header; {} is taken", said,
                           in_header, as_header ? "the header, which ANALOG:RATE confirms," : "the parameter"));
  } else if (!is_c3d_rate(said)) {
    note(file.repairs, "POINT:RATE is missing; {} Hz from the header", in_header);
  }
  if (layout.channels > 0 && is_c3d_rate(analog) && std::abs(analog - file.point_rate_hz * ratio) > 1e-3 * analog) {
    contradict(analog / ratio, file.point_rate_hz,
               fmt::format("ANALOG:RATE says {} Hz, but {} samples stand in each frame: {} Hz is taken", analog,
                           layout.analog_per_frame, file.point_rate_hz * ratio));
  }
}

/// Reads the first 512 bytes. Throws ReadError if they do not belong to a C3D file.
std::vector<std::byte> read_head_block(ByteSource& source, const std::filesystem::path& path) {
  if (source.size() < kC3dBlock)
    throw ReadError(path, 0, "the file has {} bytes; a C3D file begins with a header of 512: it is cut off or none",
                    source.size());
  const auto first = source.view(0, kC3dBlock);
  if (first[1] != std::byte{0x50}) {
    throw ReadError(path, 0, "the second byte is 0x{:02x}, in a C3D file it is 0x50; this is another format",
                    static_cast<unsigned>(first[1]));
  }
  return {first.begin(), first.end()};
}

/// The place of the parameter section and the processor that it names.
struct ParameterSection {
  std::size_t begin = 0;
  C3dProcessor processor = C3dProcessor::intel;
};

/// Finds the section at the block that the header names, else at block 2; empty if neither block begins one.
std::optional<ParameterSection> find_parameters(std::size_t block, ByteSource& source, std::vector<Repair>& repairs) {
  const std::size_t named = block == 0 ? 0 : (block - 1) * kC3dBlock;
  for (const std::size_t begin : {named, kC3dBlock}) {
    if (begin < kC3dBlock || begin + 4 > source.size()) continue;
    const auto code = static_cast<std::uint8_t>(source.view(begin, 4)[3]);
    if (code < 84 || code > 86) continue;
    if (begin != named) note(repairs, "no parameters at block {}, where the header says; found at block 2", block);
    return ParameterSection{begin, static_cast<C3dProcessor>(code)};
  }
  return std::nullopt;
}

/// Returns the processor of a file without a parameter section.
C3dProcessor processor_of_header(std::span<const std::byte> head,
                                 std::size_t block,
                                 std::uint64_t file_size,
                                 const std::filesystem::path& path,
                                 std::vector<Repair>& repairs) {
  const auto guess = guess_processor(head, file_size);
  if (!guess)
    throw ReadError(path, 0,
                    "no parameter section at block {}, and the header makes no sense for any of the three "
                    "processors; the file is damaged",
                    block);
  note(repairs,
       "there is no parameter section (byte 1 says block {}); the header is read as {}'s, "
       "and points and channels have no names, units or scales",
       block,
       *guess == C3dProcessor::intel ? "Intel"
       : *guess == C3dProcessor::sgi ? "SGI"
                                     : "DEC");
  return *guess;
}

/// Reads the groups of a section that ends at the data, at most 32 MiB after its beginning.
std::vector<C3dGroup> read_groups(const ParameterSection& section,
                                  const C3dHeader& header,
                                  ByteSource& source,
                                  std::vector<Repair>& repairs) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 25U;
  const std::uint64_t data = header.data_block == 0 ? 0 : (header.data_block - 1) * std::uint64_t{kC3dBlock};
  const std::uint64_t end = data > section.begin ? std::min(data, source.size()) : source.size();
  const auto limit = static_cast<std::size_t>(std::min(end, section.begin + kMost));
  return parse_c3d_parameters(source.view(0, limit), section.begin + 4, limit, C3dBytes{section.processor}, repairs);
}

}  // namespace

C3dHead read_c3d_head(ByteSource& source, const std::filesystem::path& path) {
  refuse_text_transfer(source, path);
  const std::vector<std::byte> head = read_head_block(source, path);
  const auto block = static_cast<std::size_t>(head[0]);
  C3dFile file;
  const auto section = find_parameters(block, source, file.repairs);
  file.processor = section ? section->processor : processor_of_header(head, block, source.size(), path, file.repairs);
  const C3dBytes number{file.processor};
  const C3dHeader header = read_c3d_header(head, number);
  if (section) file.groups = read_groups(*section, header, source, file.repairs);

  const C3dLayout layout = find_c3d_layout(header, file, source.size(), path, file.repairs);
  file.integer = layout.integer;
  file.point_scale = layout.scale;
  file.first_frame = layout.first_frame;
  file.analog_per_frame = static_cast<int>(layout.analog_per_frame);
  read_rates(file, header, layout, path);
  file.point_labels =
      unique_names(all_texts(file, "POINT", "LABELS"), layout.points, "POINT:LABELS", "point", file.repairs);
  const bool no_sign = file.says_unsigned();
  read_point_unit(file, C3dFrames(layout, file.processor, no_sign), layout, source);
  read_channels(file, layout);
  read_c3d_events(file, source, head, number);
  return {std::move(file), layout, no_sign};
}

C3dFile read_c3d_source(ByteSource& source, const std::filesystem::path& path) {
  C3dHead head = read_c3d_head(source, path);
  C3dFile& file = head.file;
  const C3dLayout& layout = head.layout;
  const auto ratio = static_cast<Eigen::Index>(layout.analog_per_frame);
  file.points.resize(layout.frames, static_cast<Eigen::Index>(4 * layout.points));
  file.analog.resize(layout.channels == 0 ? 0 : layout.frames * ratio, static_cast<Eigen::Index>(layout.channels));
  const C3dFrames frames = head.frames();
  frames.each_part(source, [&](std::int64_t first, std::int64_t count, const std::byte* p) {
    for (std::int64_t k = first; k < first + count; ++k, p += layout.frame_bytes()) {
      if (layout.points > 0) frames.points(p, file.points.row(k).data());
      if (layout.channels > 0) frames.analog(p, file.analog.row(k * ratio).data());
    }
  });
  return std::move(head.file);
}

C3dFile read_c3d(const std::filesystem::path& path) {
  ByteSource source(path);
  return read_c3d_source(source, path);
}

}  // namespace myoid::recording
