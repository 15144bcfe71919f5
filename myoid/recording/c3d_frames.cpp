#include "myoid/recording/c3d_frames.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace myoid::recording {
namespace {

constexpr std::uint64_t kPartBytes = std::uint64_t{1} << 20U;  ///< Taken from the file at a time.
constexpr std::size_t kRows = 64;  ///< Turned into columns at a time, to stay in the cache.

}  // namespace

void C3dFrames::each_part(
    ByteSource& source,
    const std::function<void(std::int64_t, std::int64_t, const std::byte*)>& part) const {
  const std::uint64_t bytes = layout_.frame_bytes();
  const auto most = static_cast<std::int64_t>(std::max<std::uint64_t>(1, kPartBytes / bytes));
  for (std::int64_t frame = 0; frame < layout_.frames; frame += most) {
    const std::int64_t count = std::min(most, layout_.frames - frame);
    const auto view = source.view(layout_.data_offset + static_cast<std::uint64_t>(frame) * bytes,
                                  static_cast<std::size_t>(count) * bytes);
    part(frame, count, view.data());
  }
}

void C3dFrames::points(const std::byte* frame, float* out) const {
  const std::size_t count = 4 * layout_.points;
  if (!layout_.integer) return reals(frame, out, count);
  const auto scale = static_cast<double>(layout_.scale);
  for (std::size_t i = 0; i < count; i += 4, frame += 8) {
    // The product in double and then rounded: what a file of reals of the same data holds.
    for (std::size_t axis = 0; axis < 3; ++axis)
      out[i + axis] =
          static_cast<float>(static_cast<double>(number_.i16(frame + 2 * axis)) * scale);
    out[i + 3] = static_cast<float>(number_.i16(frame + 6));
  }
}

void C3dFrames::analog(const std::byte* frame, float* out) const {
  const std::byte* p = frame + 4 * layout_.points * word_bytes();
  const std::size_t count = layout_.channels * layout_.analog_per_frame;
  if (!layout_.integer) return reals(p, out, count);
  for (std::size_t i = 0; i < count; ++i, p += 2)
    out[i] = is_unsigned_ ? static_cast<float>(number_.u16(p)) : static_cast<float>(number_.i16(p));
}

void C3dFrames::reals(const std::byte* p, float* out, std::size_t count) const {
  if (count == 0) return;
  if (number_.processor == C3dProcessor::intel) {
    std::memcpy(out, p, 4 * count);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) out[i] = number_.real(p + 4 * i);
}

AnalogCounts C3dFrames::empty_counts() const {
  AnalogCounts counts;
  const auto rows = static_cast<Eigen::Index>(layout_.analog_per_frame) * layout_.frames;
  const auto columns = static_cast<Eigen::Index>(layout_.channels);
  if (!layout_.integer) {
    counts.values = AnalogCounts::Columns<float>(rows, columns);
  } else if (is_unsigned_) {
    counts.values = AnalogCounts::Columns<std::uint16_t>(rows, columns);
  } else {
    counts.values = AnalogCounts::Columns<std::int16_t>(rows, columns);
  }
  return counts;
}

template <typename T, typename Decode>
void C3dFrames::transpose(const std::byte* bytes,
                          std::int64_t first,
                          std::int64_t count,
                          AnalogCounts::Columns<T>& columns,
                          Decode&& decode) const {
  const std::size_t ratio = layout_.analog_per_frame;
  const std::size_t width = word_bytes();
  const std::size_t samples = static_cast<std::size_t>(count) * ratio;
  const std::size_t begin = static_cast<std::size_t>(first) * ratio;
  const auto stride = static_cast<std::size_t>(columns.rows());
  std::array<const std::byte*, kRows> row;
  for (std::size_t block = 0; block < samples; block += kRows) {
    const std::size_t rows = std::min(kRows, samples - block);
    for (std::size_t r = 0; r < rows; ++r) {
      const std::size_t sample = block + r;
      row[r] = bytes + sample / ratio * layout_.frame_bytes() + 4 * layout_.points * width +
               sample % ratio * layout_.channels * width;
    }
    for (std::size_t c = 0; c < layout_.channels; ++c) {
      T* const out = columns.data() + c * stride + begin + block;
      for (std::size_t r = 0; r < rows; ++r) out[r] = decode(row[r] + c * width);
    }
  }
}

void C3dFrames::counts(const std::byte* bytes,
                       std::int64_t first,
                       std::int64_t count,
                       AnalogCounts& columns) const {
  // The byte order is decided outside of the loops.
  const auto in_order = [&]<C3dProcessor kProcessor>() {
    constexpr C3dBytes number{kProcessor};
    if (auto* reals = std::get_if<AnalogCounts::Columns<float>>(&columns.values)) {
      transpose(bytes, first, count, *reals,
                [number](const std::byte* p) { return number.real(p); });
    } else if (auto* some = std::get_if<AnalogCounts::Columns<std::int16_t>>(&columns.values)) {
      transpose(bytes, first, count, *some, [number](const std::byte* p) { return number.i16(p); });
    } else {
      transpose(bytes, first, count, std::get<AnalogCounts::Columns<std::uint16_t>>(columns.values),
                [number](const std::byte* p) { return number.u16(p); });
    }
  };
  if (number_.processor == C3dProcessor::intel) return in_order.operator()<C3dProcessor::intel>();
  if (number_.processor == C3dProcessor::dec) return in_order.operator()<C3dProcessor::dec>();
  return in_order.operator()<C3dProcessor::sgi>();
}

}  // namespace myoid::recording
