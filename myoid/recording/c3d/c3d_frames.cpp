#include "myoid/recording/c3d/c3d_frames.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace myoid::recording {
namespace {

constexpr std::uint64_t kPartBytes = std::uint64_t{1} << 20U;  ///< Read from the file at once.
constexpr std::size_t kRows = 64;  ///< Turned into columns at once, so that they stay in the cache.

}  // namespace

void C3dFrames::each_part(ByteSource& source,
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

namespace {

// The byte order is a template parameter, so that the loops do not test it.
template <C3dProcessor kProcessor>
void scaled_points(const std::byte* p, std::size_t points, double scale, float* out) {
  constexpr C3dBytes kNumber{kProcessor};
  for (std::size_t i = 0; i < points; ++i, p += 8, out += 4) {
    // The product is formed in double and then rounded, as in a file of reals.
    out[0] = static_cast<float>(static_cast<double>(kNumber.i16(p)) * scale);
    out[1] = static_cast<float>(static_cast<double>(kNumber.i16(p + 2)) * scale);
    out[2] = static_cast<float>(static_cast<double>(kNumber.i16(p + 4)) * scale);
    out[3] = static_cast<float>(kNumber.i16(p + 6));
  }
}

template <C3dProcessor kProcessor>
void integers(const std::byte* p, std::size_t count, bool is_unsigned, float* out) {
  constexpr C3dBytes kNumber{kProcessor};
  if (is_unsigned) {
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(kNumber.u16(p + 2 * i));
  } else {
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(kNumber.i16(p + 2 * i));
  }
}

}  // namespace

void C3dFrames::points(const std::byte* frame, float* out) const {
  if (!layout_.integer) return reals(frame, out, 4 * layout_.points);
  const auto scale = static_cast<double>(layout_.scale);
  // DEC and Intel store integers alike.
  if (number_.processor == C3dProcessor::sgi)
    return scaled_points<C3dProcessor::sgi>(frame, layout_.points, scale, out);
  scaled_points<C3dProcessor::intel>(frame, layout_.points, scale, out);
}

void C3dFrames::analog(const std::byte* frame, float* out) const {
  const std::byte* p = frame + 4 * layout_.points * word_bytes();
  const std::size_t count = layout_.channels * layout_.analog_per_frame;
  if (!layout_.integer) return reals(p, out, count);
  if (number_.processor == C3dProcessor::sgi) return integers<C3dProcessor::sgi>(p, count, is_unsigned_, out);
  integers<C3dProcessor::intel>(p, count, is_unsigned_, out);
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

void C3dFrames::counts(const std::byte* bytes, std::int64_t first, std::int64_t count, AnalogCounts& columns) const {
  // The byte order is a template parameter, so that the loops do not test it.
  const auto in_order = [&]<C3dProcessor kProcessor>() {
    constexpr C3dBytes number{kProcessor};
    if (auto* reals = std::get_if<AnalogCounts::Columns<float>>(&columns.values)) {
      transpose(bytes, first, count, *reals, [number](const std::byte* p) { return number.real(p); });
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
