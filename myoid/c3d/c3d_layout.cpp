#include "myoid/c3d/c3d_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/c3d/c3d_bytes.h"
#include "myoid/core/error.h"

namespace myoid::recording {
namespace {

bool is_rate(double rate) { return std::isfinite(rate) && rate > 1e-3 && rate < 1e7; }

/// A count in a parameter: 16 bits without sign, or a real.
std::optional<std::size_t> count_in(const C3dParameter* parameter) {
  const auto value = number_at(parameter, 0);
  if (!value) return std::nullopt;
  const double count = *value < 0.0 && *value >= -32768.0 ? *value + 65536.0 : *value;
  if (!(count >= 0.0 && count < 4e9)) return std::nullopt;
  return static_cast<std::size_t>(count);
}

/// Two 16-bit words, the lower first, as TRIAL:ACTUAL_START_FIELD holds them.
std::optional<std::int64_t> long_count(const C3dParameter* parameter) {
  const auto low = number_at(parameter, 0);
  const auto high = number_at(parameter, 1);
  if (!low || !high) return std::nullopt;
  const auto word = [](double value) {
    return static_cast<std::int64_t>(value < 0.0 ? value + 65536.0 : value);
  };
  if (std::abs(*low) > 65535.0 || std::abs(*high) > 65535.0) return std::nullopt;
  return word(*low) + 65536 * word(*high);
}

struct Shape {
  std::size_t channels, analog_per_frame;
  friend bool operator==(const Shape&, const Shape&) = default;
};

struct Frames {
  std::int64_t count, first;
  std::string source;
};

template <typename T>
void add_new(std::vector<T>& list, const T& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

/// Every number of points that header or parameters name, the header's first.
std::vector<std::size_t> point_counts(const C3dHeader& header, const C3dFile& file) {
  std::vector<std::size_t> list{header.points};
  if (const auto used = count_in(file.find("POINT", "USED"))) add_new(list, *used);
  return list;
}

/// The same for the analog samples.
std::vector<Shape> analog_shapes(const C3dHeader& header, const C3dFile& file) {
  std::vector<Shape> list;
  const std::size_t total = header.analog_total;
  const std::size_t ratio = header.analog_per_frame;
  if (total == 0) {
    list.push_back({0, std::max<std::size_t>(1, ratio)});
  } else if (ratio > 0 && total % ratio == 0) {
    list.push_back({total / ratio, ratio});
  }
  if (const auto used = count_in(file.find("ANALOG", "USED"))) {
    if (*used > 0 && total > 0 && total % *used == 0) add_new(list, Shape{*used, total / *used});
    if (ratio > 0) add_new(list, Shape{*used, ratio});
    const double analog = number_at(file.find("ANALOG", "RATE"), 0).value_or(0.0);
    const double point = number_at(file.find("POINT", "RATE"), 0).value_or(0.0);
    if (is_rate(analog) && is_rate(point) && analog / point < 65536.0 && analog >= 0.5 * point)
      add_new(list, Shape{*used, static_cast<std::size_t>(std::lround(analog / point))});
    if (*used == 0) add_new(list, Shape{0, 1});
  }
  if (list.empty()) list.push_back({total, 1});
  return list;
}

/// The same for the frames.
std::vector<Frames> frame_counts(const C3dHeader& header, const C3dFile& file) {
  std::vector<Frames> list;
  const auto add = [&](std::int64_t count, std::int64_t first, const char* source) {
    if (count > 0 &&
        std::none_of(list.begin(), list.end(), [&](const Frames& f) { return f.count == count; }))
      list.push_back({count, first, source});
  };
  const auto start = long_count(file.find("TRIAL", "ACTUAL_START_FIELD"));
  const auto end = long_count(file.find("TRIAL", "ACTUAL_END_FIELD"));
  const auto add_actual = [&] {
    if (start && end)
      add(*end - *start + 1, *start, "TRIAL:ACTUAL_START_FIELD and ACTUAL_END_FIELD");
  };
  // Frames beyond the header's 16 bits stand there as the largest number or wrapped around.
  if (end && *end >= 65535 && (header.last_frame >= 65535 || header.last_frame == *end % 65536))
    add_actual();
  add(header.last_frame - header.first_frame + 1, header.first_frame, "the header");
  add_actual();
  if (const auto count = count_in(file.find("POINT", "LONG_FRAMES")))
    add(static_cast<std::int64_t>(*count), header.first_frame, "POINT:LONG_FRAMES");
  if (const auto count = count_in(file.find("POINT", "FRAMES")))
    add(static_cast<std::int64_t>(*count), header.first_frame, "POINT:FRAMES");
  return list;
}

/// Header and parameters that do not tell of the same frames, whichever the size confirms.
void say_other_frame_counts(const C3dHeader& header,
                            const C3dFile& file,
                            const std::vector<Frames>& frames,
                            const Frames& chosen,
                            std::vector<Repair>& repairs) {
  const std::int64_t in_header = header.last_frame - header.first_frame + 1;
  if (in_header <= 0) {
    repairs.push_back(
        {0, fmt::format("the header says frames {} to {}, which is no range; {} says "
                        "{} frames. If the first one is wrong, so is the time of all",
                        header.first_frame, header.last_frame, chosen.source, chosen.count)});
  } else if (&chosen != frames.data()) {
    repairs.push_back(
        {0, fmt::format("{} says {} frames, {} says {}; the file's size confirms the "
                        "latter",
                        frames[0].source, frames[0].count, chosen.source, chosen.count)});
  } else if (const auto said = count_in(file.find("POINT", "FRAMES"));
             said && *said > 0 && *said < 65535 &&
             static_cast<std::int64_t>(*said) != chosen.count % 65536) {
    repairs.push_back({0, fmt::format("POINT:FRAMES says {} frames, the header {} ({} to {}); the "
                                      "header is taken",
                                      *said, in_header, header.first_frame, header.last_frame)});
  }
}

/// Poses of segments, which Theia3D, Visual3D and others write as 4 x 4 matrices, and the remedy.
std::string rotations_text(const C3dFile& file, std::size_t count) {
  constexpr std::size_t kMost = 6;
  std::string names;
  if (const C3dParameter* labels = file.find("ROTATION", "LABELS")) {
    const auto list = texts(*labels);
    for (std::size_t i = 0; i < std::min(list.size(), kMost); ++i)
      names += (i == 0 ? ": " : ", ") + list[i];
    if (list.size() > kMost) names += ", ...";
  }
  return fmt::format(
      "the poses of {} segments (group ROTATION{}), as Theia3D and Visual3D write "
      "them, are not read",
      count, names);
}

}  // namespace

C3dHeader read_c3d_header(std::span<const std::byte> head, const C3dBytes& number) {
  const auto word = [&](std::size_t n) { return number.u16(&head[2 * (n - 1)]); };
  C3dHeader header;
  header.points = word(2);
  header.analog_total = word(3);
  header.first_frame = word(4);
  header.last_frame = word(5);
  header.scale = number.real(&head[12]);
  header.data_block = word(9);
  header.analog_per_frame = word(10);
  header.rate_hz = number.real(&head[20]);
  return header;
}

std::optional<C3dProcessor> guess_processor(std::span<const std::byte> head,
                                            std::uint64_t file_size) {
  for (const C3dProcessor p : {C3dProcessor::intel, C3dProcessor::sgi, C3dProcessor::dec}) {
    const C3dHeader h = read_c3d_header(head, {p});
    const double scale = std::abs(static_cast<double>(h.scale));
    if (is_rate(static_cast<double>(h.rate_hz)) && h.rate_hz >= 1.0F && scale > 1e-6 &&
        scale < 1e4 && h.data_block >= 2 && (h.data_block - 1) * kC3dBlock < file_size &&
        h.points + h.analog_total > 0 && h.points < 10000)
      return p;
  }
  return std::nullopt;
}

C3dLayout find_c3d_layout(const C3dHeader& header,
                          const C3dFile& file,
                          std::uint64_t file_size,
                          const std::filesystem::path& path,
                          std::vector<Repair>& repairs) {
  C3dLayout layout;
  const std::size_t rotations = count_in(file.find("ROTATION", "USED")).value_or(0);
  const bool nothing_else = header.points == 0 && header.analog_total == 0 &&
                            count_in(file.find("POINT", "USED")).value_or(0) == 0 &&
                            count_in(file.find("ANALOG", "USED")).value_or(0) == 0;
  if (rotations > 0 && nothing_else)
    throw ReadError(path, 0,
                    fmt::format("{}, and the file holds neither markers nor analog channels. In "
                                "Visual3D make landmarks of the segments and export them as .trc "
                                "or C3D, or export the joint angles as .mot or .csv",
                                rotations_text(file, rotations)));

  // Where the data begin.
  const auto data_start = count_in(file.find("POINT", "DATA_START"));
  std::size_t block = header.data_block;
  const auto inside = [&](std::size_t b) { return b >= 2 && (b - 1) * kC3dBlock < file_size; };
  if (!inside(block)) {
    if (!data_start || !inside(*data_start)) {
      throw ReadError(path, 0,
                      fmt::format("the data should begin at block {}, which the file of {} bytes "
                                  "does not have; it is cut off: copy or export it again",
                                  block, file_size));
    }
    repairs.push_back({0, fmt::format("the header says the data begin at block {}, which the file "
                                      "does not have; taken from POINT:DATA_START = {}",
                                      block, *data_start)});
    block = *data_start;
  } else if (data_start && *data_start != block) {
    repairs.push_back({0, fmt::format("POINT:DATA_START says block {}, the header block {}; the "
                                      "header is taken",
                                      *data_start, block)});
  }
  layout.data_offset = (block - 1) * kC3dBlock;
  std::uint64_t available = file_size - layout.data_offset;
  if (rotations > 0) {
    repairs.push_back(
        {0, rotations_text(file, rotations) + "; export landmarks of them to use them as markers"});
    const auto at = count_in(file.find("ROTATION", "DATA_START"));
    if (at && inside(*at) && *at > block) available = (*at - block) * kC3dBlock;
  }

  // Integers or reals.
  const double point_scale = number_at(file.find("POINT", "SCALE"), 0).value_or(0.0);
  const bool header_scale_good = std::isfinite(header.scale) && header.scale != 0.0F;
  const double scale = header_scale_good ? static_cast<double>(header.scale) : point_scale;
  if (!header_scale_good && (header.points > 0 || header.analog_total > 0)) {
    if (scale == 0.0)
      throw ReadError(path, 0,
                      fmt::format("the scale of the points is {} in the header and not in "
                                  "POINT:SCALE either: neither the kind nor the size of the "
                                  "samples is known",
                                  header.scale));
    repairs.push_back({0, fmt::format("the header's scale is {}; taken from POINT:SCALE = {}",
                                      header.scale, point_scale)});
  }
  std::vector<bool> kinds{scale > 0.0};
  if (point_scale != 0.0 && (point_scale > 0.0) != (scale > 0.0)) kinds.push_back(!kinds[0]);

  // The first of the stories that the size of the file confirms, up to the padding of its end.
  const auto points = point_counts(header, file);
  const auto shapes = analog_shapes(header, file);
  const auto frames = frame_counts(header, file);
  if (frames.empty())
    throw ReadError(path, 0, "the file holds no frames; record or export it again");
  const auto bytes = [&](bool integer, std::size_t p, const Shape& s, std::int64_t n) {
    return (4 * p + s.channels * s.analog_per_frame) * (integer ? 2U : 4U) *
           static_cast<std::uint64_t>(n);
  };
  const auto confirmed = [&](std::uint64_t needed, std::uint64_t padding) {
    return needed > 0 && needed <= available && available - needed < padding;
  };
  bool found = false;
  const Frames* chosen = frames.data();
  const auto take = [&](bool integer, std::size_t p, const Shape& s, const Frames& f) {
    layout.integer = integer;
    layout.points = p;
    layout.channels = s.channels;
    layout.analog_per_frame = s.analog_per_frame;
    chosen = &f;
    found = true;
  };
  // Up to a whole block behind the data first: what needs more of it is less likely.
  for (const std::uint64_t padding : {kC3dBlock, 2 * kC3dBlock}) {
    for (const bool kind : kinds) {
      for (const Shape& s : shapes) {
        for (const std::size_t p : points) {
          for (const Frames& f : frames) {
            if (!found && confirmed(bytes(kind, p, s, f.count), padding)) take(kind, p, s, f);
          }
        }
      }
    }
  }
  const bool as_header =
      layout.points == header.points &&
      (layout.channels == 0 || layout.analog_per_frame == header.analog_per_frame) &&
      layout.channels * layout.analog_per_frame == header.analog_total;
  if (found && !as_header) {
    repairs.push_back({0, fmt::format("the header says {} points and {} analog samples in a frame; "
                                      "the file's size confirms {} points, {} channels, {} samples "
                                      "a frame, as the parameters say",
                                      header.points, header.analog_total, layout.points,
                                      layout.channels, layout.analog_per_frame)});
  } else if (found && points.size() > 1) {
    repairs.push_back({0, fmt::format("POINT:USED says {} points, the header {}; the file's size "
                                      "confirms the header",
                                      points[1], points[0])});
  } else if (found &&
             count_in(file.find("ANALOG", "USED")).value_or(layout.channels) != layout.channels) {
    repairs.push_back({0, fmt::format("ANALOG:USED says {} channels, the header {}; the file's "
                                      "size confirms the header",
                                      *count_in(file.find("ANALOG", "USED")), layout.channels)});
  }
  if (found && layout.integer != kinds[0])
    repairs.push_back({0, fmt::format("the header's scale {} says the samples are {}, the file's "
                                      "size that they are {}, as POINT:SCALE does",
                                      header.scale, kinds[0] ? "integers" : "reals",
                                      layout.integer ? "integers" : "reals")});
  if (!found) {
    const bool one_story =
        points.size() == 1 && kinds.size() == 1 &&
        count_in(file.find("ANALOG", "USED")).value_or(shapes[0].channels) == shapes[0].channels;
    if (!one_story) {
      throw ReadError(
          path, 0,
          fmt::format("header and parameters disagree ({} or {} points, {} analog samples a frame "
                      "or {} channels) and the file's size of {} bytes confirms neither; export "
                      "the file again",
                      points.front(), points.back(), header.analog_total,
                      count_in(file.find("ANALOG", "USED")).value_or(0), file_size));
    }
    take(kinds[0], points[0], shapes[0], frames[0]);
    // A count that wrapped at 65536 is too small by a multiple of it; one that fits is better than
    // one that does not.
    for (const Frames& f : frames) {
      const bool fits = bytes(kinds[0], points[0], shapes[0], f.count) <= available;
      const bool now_fits = bytes(kinds[0], points[0], shapes[0], chosen->count) <= available;
      if (fits && (!now_fits || f.count > chosen->count)) chosen = &f;
    }
  }
  say_other_frame_counts(header, file, frames, *chosen, repairs);
  layout.scale = std::abs(static_cast<float>(scale));
  if (layout.integer && header_scale_good && point_scale != 0.0 &&
      std::abs(std::abs(point_scale) - std::abs(scale)) > 1e-6 * std::abs(scale)) {
    repairs.push_back({0, fmt::format("POINT:SCALE = {:.6g}, the header says {:.6g}; the header is "
                                      "taken: compare a known distance",
                                      point_scale, scale)});
  }
  layout.frames = chosen->count;
  layout.first_frame = chosen->first;
  if (layout.frame_bytes() == 0)
    throw ReadError(path, 0, "the file holds neither points nor analog channels");
  const auto whole = static_cast<std::int64_t>(
      std::min<std::uint64_t>(available / layout.frame_bytes(), std::uint64_t{1} << 40U));
  if (whole < layout.frames) {
    if (whole == 0)
      throw ReadError(path, 0,
                      fmt::format("the file is cut off at byte {}, inside its first frame; copy or "
                                  "export it again",
                                  file_size));
    repairs.push_back({0, fmt::format("the file is cut off at byte {}: {} of {} frames are there "
                                      "and taken",
                                      file_size, whole, layout.frames)});
    layout.frames = whole;
  } else if (!found && rotations == 0) {
    repairs.push_back(
        {0, fmt::format(
                "{} bytes behind the last frame are not understood and left out",
                available - static_cast<std::uint64_t>(layout.frames) * layout.frame_bytes())});
  }
  return layout;
}

}  // namespace myoid::recording
