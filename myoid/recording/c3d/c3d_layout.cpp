#include "myoid/recording/c3d/c3d_layout.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/c3d/c3d_bytes.h"

namespace myoid::recording {
namespace {

/// Returns the count in a parameter: 16 bits without sign, or a real.
std::optional<std::size_t> count_in(const C3dParameter* parameter) {
  const auto value = number_at(parameter, 0);
  if (!value) return std::nullopt;
  const double count = *value < 0.0 && *value >= -32768.0 ? *value + 65536.0 : *value;
  if (!(count >= 0.0 && count < 4e9)) return std::nullopt;
  return static_cast<std::size_t>(count);
}

/// Joins two 16-bit words, the lower first, as in TRIAL:ACTUAL_START_FIELD.
std::optional<std::int64_t> long_count(const C3dParameter* parameter) {
  const auto low = number_at(parameter, 0);
  const auto high = number_at(parameter, 1);
  if (!low || !high) return std::nullopt;
  const auto word = [](double value) { return static_cast<std::int64_t>(value < 0.0 ? value + 65536.0 : value); };
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

/// Collects every number of points that header and parameters state, the header's first.
std::vector<std::size_t> point_counts(const C3dHeader& header, const C3dFile& file) {
  std::vector<std::size_t> list{header.points};
  if (const auto used = count_in(file.find("POINT", "USED"))) add_new(list, *used);
  return list;
}

/// Collects every number of channels and samples that header and parameters state, the header's first.
std::vector<Shape> analog_shapes(const C3dHeader& header, const C3dFile& file) {
  std::vector<Shape> list;
  const std::size_t total = header.analog_total;
  const std::size_t ratio = header.analog_per_frame;
  const auto used = count_in(file.find("ANALOG", "USED"));
  const double analog = number_at(file.find("ANALOG", "RATE"), 0).value_or(0.0);
  const double point = number_at(file.find("POINT", "RATE"), 0).value_or(0.0);
  const bool has_rates = is_c3d_rate(analog) && is_c3d_rate(point) && analog / point < 65536.0 && analog >= 0.5 * point;
  const std::size_t of_rates = has_rates ? static_cast<std::size_t>(std::lround(analog / point)) : 0;
  // The header's total, the channels and both rates outweigh the header's samples in a frame.
  if (used && total > 0 && *used * of_rates == total) list.push_back({*used, of_rates});
  if (total == 0) {
    list.push_back({0, std::max<std::size_t>(1, ratio)});
  } else if (ratio > 0 && total % ratio == 0) {
    add_new(list, Shape{total / ratio, ratio});
  }
  if (used) {
    if (*used > 0 && total > 0 && total % *used == 0) add_new(list, Shape{*used, total / *used});
    if (ratio > 0) add_new(list, Shape{*used, ratio});
    if (has_rates) add_new(list, Shape{*used, of_rates});
    if (*used == 0) add_new(list, Shape{0, 1});
  }
  if (list.empty()) list.push_back({total, 1});
  return list;
}

/// Collects every range of frames that header and parameters state, the header's first.
std::vector<Frames> frame_counts(const C3dHeader& header, const C3dFile& file) {
  std::vector<Frames> list;
  const auto add = [&](std::int64_t count, std::int64_t first, const char* source) {
    if (count > 0 && std::none_of(list.begin(), list.end(), [&](const Frames& f) { return f.count == count; }))
      list.push_back({count, first, source});
  };
  const auto start = long_count(file.find("TRIAL", "ACTUAL_START_FIELD"));
  const auto end = long_count(file.find("TRIAL", "ACTUAL_END_FIELD"));
  const auto add_actual = [&] {
    if (start && end) add(*end - *start + 1, *start, "TRIAL:ACTUAL_START_FIELD and ACTUAL_END_FIELD");
  };
  // The header has 16 bits for a frame: a larger number stands there as 65535 or modulo 65536.
  if (end && *end >= 65535 && (header.last_frame >= 65535 || header.last_frame == *end % 65536)) add_actual();
  add(header.last_frame - header.first_frame + 1, header.first_frame, "the header");
  add_actual();
  if (const auto count = count_in(file.find("POINT", "LONG_FRAMES")))
    add(static_cast<std::int64_t>(*count), header.first_frame, "POINT:LONG_FRAMES");
  if (const auto count = count_in(file.find("POINT", "FRAMES")))
    add(static_cast<std::int64_t>(*count), header.first_frame, "POINT:FRAMES");
  return list;
}

/// Notes that header and parameters state different frames, whichever the size confirms.
void say_other_frame_counts(const C3dHeader& header,
                            const C3dFile& file,
                            const std::vector<Frames>& frames,
                            const Frames& chosen,
                            std::vector<Repair>& repairs) {
  const std::int64_t in_header = header.last_frame - header.first_frame + 1;
  if (in_header <= 0) {
    note(repairs,
         "the header says frames {} to {}, which is no range; {} says {} frames. If the "
         "first one is wrong, so is the time of all",
         header.first_frame, header.last_frame, chosen.source, chosen.count);
  } else if (&chosen != frames.data()) {
    note(repairs, "{} says {} frames, {} says {}; the file's size confirms the latter", frames[0].source,
         frames[0].count, chosen.source, chosen.count);
  } else if (const auto said = count_in(file.find("POINT", "FRAMES"));
             said && *said > 0 && *said < 65535 && static_cast<std::int64_t>(*said) != chosen.count % 65536) {
    note(repairs, "POINT:FRAMES says {} frames, the header {} ({} to {}); the header is taken", *said, in_header,
         header.first_frame, header.last_frame);
  }
}

/// Describes poses of segments, which Theia3D, Visual3D and others write as 4 x 4 matrices, and the remedy.
std::string rotations_text(const C3dFile& file, std::size_t count) {
  constexpr std::size_t kMost = 6;
  std::string names;
  if (const C3dParameter* labels = file.find("ROTATION", "LABELS")) {
    const auto list = texts(*labels);
    for (std::size_t i = 0; i < std::min(list.size(), kMost); ++i) names += (i == 0 ? ": " : ", ") + list[i];
    if (list.size() > kMost) names += ", ...";
  }
  return fmt::format("the poses of {} segments (group ROTATION{}), as Theia3D and Visual3D write them, are not read",
                     count, names);
}

/// Throws ReadError, with the remedy, for a file that holds only segment poses.
void refuse_poses_alone(const C3dHeader& header,
                        const C3dFile& file,
                        std::size_t rotations,
                        const std::filesystem::path& path) {
  const bool nothing_else = header.points == 0 && header.analog_total == 0 &&
                            count_in(file.find("POINT", "USED")).value_or(0) == 0 &&
                            count_in(file.find("ANALOG", "USED")).value_or(0) == 0;
  if (rotations == 0 || !nothing_else) return;
  throw ReadError(path, 0,
                  "{}, and the file holds neither markers nor analog channels. In Visual3D make landmarks of the "
                  "segments and export them as .trc or C3D, or export the joint angles as .mot or .csv",
                  rotations_text(file, rotations));
}

bool is_block_inside(std::size_t block, std::uint64_t file_size) {
  return block >= 2 && (block - 1) * kC3dBlock < file_size;
}

/// Returns the block, counted from 1, at which the data begin.
std::size_t data_block(const C3dHeader& header,
                       const C3dFile& file,
                       std::uint64_t file_size,
                       const std::filesystem::path& path,
                       std::vector<Repair>& repairs) {
  const auto data_start = count_in(file.find("POINT", "DATA_START"));
  const std::size_t block = header.data_block;
  if (is_block_inside(block, file_size)) {
    if (data_start && *data_start != block)
      note(repairs, "POINT:DATA_START says block {}, the header block {}; the header is taken", *data_start, block);
    return block;
  }
  if (!data_start || !is_block_inside(*data_start, file_size)) {
    throw ReadError(path, 0,
                    "the data should begin at block {}, which the file of {} bytes does not have; it is "
                    "cut off: copy or export it again",
                    block, file_size);
  }
  note(repairs,
       "the header says the data begin at block {}, which the file does not have; taken from POINT:DATA_START = {}",
       block, *data_start);
  return *data_start;
}

/// The scale of the points; its sign says whether the samples are integers (positive) or reals.
struct Scale {
  double taken = 0.0;
  double in_parameters = 0.0;  ///< POINT:SCALE; 0 if there is none.
  bool header_is_good = false;
};

Scale point_scale(const C3dHeader& header,
                  const C3dFile& file,
                  const std::filesystem::path& path,
                  std::vector<Repair>& repairs) {
  Scale scale;
  scale.in_parameters = number_at(file.find("POINT", "SCALE"), 0).value_or(0.0);
  scale.header_is_good = std::isfinite(header.scale) && header.scale != 0.0F;
  scale.taken = scale.header_is_good ? static_cast<double>(header.scale) : scale.in_parameters;
  if (scale.header_is_good || (header.points == 0 && header.analog_total == 0)) return scale;
  if (scale.taken == 0.0)
    throw ReadError(path, 0,
                    "the scale of the points is {} in the header and not in POINT:SCALE either: neither "
                    "the kind nor the size of the samples is known",
                    header.scale);
  note(repairs, "the header's scale is {}; taken from POINT:SCALE = {}", header.scale, scale.in_parameters);
  return scale;
}

/// All statements of header and parameters about the samples. The size of the file decides between them.
struct Claims {
  std::vector<bool> integer;
  std::vector<std::size_t> points;
  std::vector<Shape> shapes;
  std::vector<Frames> frames;
};

/// One choice of statements.
struct Story {
  bool integer = false;
  std::size_t points = 0;
  Shape shape{};
  const Frames* frames = nullptr;

  [[nodiscard]] std::uint64_t bytes() const {
    return (4 * points + shape.channels * shape.analog_per_frame) * (integer ? 2U : 4U) *
           static_cast<std::uint64_t>(frames->count);
  }
};

Claims claims_of(const C3dHeader& header, const C3dFile& file, const Scale& scale, const std::filesystem::path& path) {
  Claims claims{
      {scale.taken > 0.0}, point_counts(header, file), analog_shapes(header, file), frame_counts(header, file)};
  if (scale.in_parameters != 0.0 && (scale.in_parameters > 0.0) != (scale.taken > 0.0))
    claims.integer.push_back(!claims.integer[0]);
  if (claims.frames.empty()) throw ReadError(path, 0, "the file holds no frames; record or export it again");
  return claims;
}

/// Returns the first choice that fills the `available` bytes up to a rest of less than `padding`.
std::optional<Story> story_with_padding(const Claims& claims, std::uint64_t available, std::uint64_t padding) {
  for (const bool integer : claims.integer) {
    for (const Shape& shape : claims.shapes) {
      for (const std::size_t points : claims.points) {
        for (const Frames& frames : claims.frames) {
          const Story story{integer, points, shape, &frames};
          const std::uint64_t needed = story.bytes();
          if (needed > 0 && needed <= available && available - needed < padding) return story;
        }
      }
    }
  }
  return std::nullopt;
}

/// Returns the first choice that the size of the file confirms. A rest of up to one block is
/// likelier than a larger one.
std::optional<Story> confirmed_story(const Claims& claims, std::uint64_t available) {
  if (const auto story = story_with_padding(claims, available, kC3dBlock)) return story;
  return story_with_padding(claims, available, 2 * kC3dBlock);
}

/// Returns a choice for a file whose size confirms none. Throws ReadError where the statements
/// disagree about more than the number of frames.
Story unconfirmed_story(const Claims& claims,
                        const C3dHeader& header,
                        const C3dFile& file,
                        std::uint64_t available,
                        std::uint64_t file_size,
                        const std::filesystem::path& path) {
  const std::optional<std::size_t> used = count_in(file.find("ANALOG", "USED"));
  const bool one_story = claims.points.size() == 1 && claims.integer.size() == 1 &&
                         used.value_or(claims.shapes[0].channels) == claims.shapes[0].channels;
  if (!one_story) {
    throw ReadError(path, 0,
                    "header and parameters disagree ({} or {} points, {} analog samples a frame or {} channels) and "
                    "the file's size of {} bytes confirms neither; export the file again",
                    claims.points.front(), claims.points.back(), header.analog_total, used.value_or(0), file_size);
  }
  Story best{claims.integer[0], claims.points[0], claims.shapes[0], claims.frames.data()};
  // A count that wrapped at 65536 is too small by a multiple of 65536; a count that fits into the file is preferred.
  for (const Frames& frames : claims.frames) {
    Story other = best;
    other.frames = &frames;
    const bool fits = other.bytes() <= available;
    if (fits && (best.bytes() > available || frames.count > best.frames->count)) best = other;
  }
  return best;
}

/// Notes where header and parameters state a number of points, of channels or a kind of samples
/// that differs from the confirmed choice.
void say_other_claims(const C3dHeader& header,
                      const C3dFile& file,
                      const Claims& claims,
                      const Story& story,
                      std::vector<Repair>& repairs) {
  const auto [channels, analog_per_frame] = story.shape;
  const bool as_header = story.points == header.points &&
                         (channels == 0 || analog_per_frame == header.analog_per_frame) &&
                         channels * analog_per_frame == header.analog_total;
  const auto used = count_in(file.find("ANALOG", "USED"));
  if (!as_header) {
    note(repairs,
         "the header says {} points and {} analog samples in a frame; the file's size "
         "confirms {} points, {} channels, {} samples a frame, as the parameters say",
         header.points, header.analog_total, story.points, channels, analog_per_frame);
  } else if (claims.points.size() > 1) {
    note(repairs, "POINT:USED says {} points, the header {}; the file's size confirms the header", claims.points[1],
         claims.points[0]);
  } else if (used && *used != channels) {
    note(repairs, "ANALOG:USED says {} channels, the header {}; the file's size confirms the header", *used, channels);
  }
  if (story.integer != claims.integer[0])
    note(repairs,
         "the header's scale {} says the samples are {}, the file's size that they are {}, as POINT:SCALE does",
         header.scale, claims.integer[0] ? "integers" : "reals", story.integer ? "integers" : "reals");
}

/// Returns the number of frames that the bytes hold, at most `said`.
std::int64_t whole_frames(std::int64_t said,
                          std::uint64_t frame_bytes,
                          std::uint64_t available,
                          std::uint64_t file_size,
                          const std::filesystem::path& path,
                          std::vector<Repair>& repairs) {
  if (frame_bytes == 0) throw ReadError(path, 0, "the file holds neither points nor analog channels");
  const auto whole =
      static_cast<std::int64_t>(std::min<std::uint64_t>(available / frame_bytes, std::uint64_t{1} << 40U));
  if (whole >= said) return said;
  if (whole == 0)
    throw ReadError(path, 0, "the file is cut off at byte {}, inside its first frame; copy or export it again",
                    file_size);
  note(repairs, "the file is cut off at byte {}: {} of {} frames are there and taken", file_size, whole, said);
  repairs.back().lost = true;
  return whole;
}

}  // namespace

C3dLayout find_c3d_layout(const C3dHeader& header,
                          const C3dFile& file,
                          std::uint64_t file_size,
                          const std::filesystem::path& path,
                          std::vector<Repair>& repairs) {
  const std::size_t rotations = count_in(file.find("ROTATION", "USED")).value_or(0);
  refuse_poses_alone(header, file, rotations, path);
  const std::size_t block = data_block(header, file, file_size, path, repairs);
  C3dLayout layout;
  layout.data_offset = (block - 1) * kC3dBlock;
  std::uint64_t available = file_size - layout.data_offset;
  if (rotations > 0) {
    repairs.push_back({0, rotations_text(file, rotations) + "; export landmarks of them to use them as markers"});
    const auto at = count_in(file.find("ROTATION", "DATA_START"));
    if (at && is_block_inside(*at, file_size) && *at > block) available = (*at - block) * kC3dBlock;
  }
  const Scale scale = point_scale(header, file, path, repairs);
  const Claims claims = claims_of(header, file, scale, path);
  const std::optional<Story> confirmed = confirmed_story(claims, available);
  if (confirmed) say_other_claims(header, file, claims, *confirmed, repairs);
  const Story story = confirmed ? *confirmed : unconfirmed_story(claims, header, file, available, file_size, path);
  say_other_frame_counts(header, file, claims.frames, *story.frames, repairs);
  layout.integer = story.integer;
  layout.points = story.points;
  layout.channels = story.shape.channels;
  layout.analog_per_frame = story.shape.analog_per_frame;
  layout.first_frame = story.frames->first;
  layout.scale = std::abs(static_cast<float>(scale.taken));
  if (layout.integer && scale.header_is_good && scale.in_parameters != 0.0 &&
      std::abs(std::abs(scale.in_parameters) - std::abs(scale.taken)) > 1e-6 * std::abs(scale.taken)) {
    note(repairs, "POINT:SCALE = {:.6g}, the header says {:.6g}; the header is taken: compare a known distance",
         scale.in_parameters, scale.taken);
  }
  layout.frames = whole_frames(story.frames->count, layout.frame_bytes(), available, file_size, path, repairs);
  if (layout.frames == story.frames->count && !confirmed && rotations == 0) {
    note(repairs, "{} bytes behind the last frame are not understood and left out",
         available - static_cast<std::uint64_t>(layout.frames) * layout.frame_bytes());
  }
  return layout;
}

}  // namespace myoid::recording
