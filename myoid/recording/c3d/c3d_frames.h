#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "myoid/ground/files/analog_channels.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/recording/c3d/c3d_bytes.h"
#include "myoid/recording/c3d/c3d_layout.h"

namespace myoid::recording {

/// Reads the samples of a C3D file some frames at a time, so that a large file need not be in
/// memory together with the result.
class C3dFrames {
 public:
  C3dFrames(const C3dLayout& layout, C3dProcessor processor, bool is_unsigned)
      : layout_(layout), number_{processor}, is_unsigned_(is_unsigned) {}

  /// Calls `part(first, count, bytes)` for consecutive frames [first, first + count) of the data.
  /// Throws ReadError if reading fails.
  void each_part(ByteSource& source,
                 const std::function<void(std::int64_t, std::int64_t, const std::byte*)>& part) const;

  /// Returns the points of the frame at `frame`: x, y, z [POINT:UNITS] and the fourth word of each.
  /// An integer times the scale is rounded as in a file of reals of the same data.
  void points(const std::byte* frame, float* out) const;
  /// Returns the frame's analog samples as stored: the first sample of all channels, then the second of all, ....
  void analog(const std::byte* frame, float* out) const;

  /// Returns columns with room for all samples, in the file's own kind of number.
  [[nodiscard]] AnalogCounts empty_counts() const;
  /// Writes the samples of `count` frames into such columns, from frame `first` of the data on.
  void counts(const std::byte* bytes, std::int64_t first, std::int64_t count, AnalogCounts& columns) const;

 private:
  void reals(const std::byte* p, float* out, std::size_t count) const;
  template <typename T, typename Decode>
  void transpose(const std::byte* bytes,
                 std::int64_t first,
                 std::int64_t count,
                 AnalogCounts::Columns<T>& columns,
                 Decode&& decode) const;
  [[nodiscard]] std::size_t word_bytes() const { return layout_.integer ? 2 : 4; }

  C3dLayout layout_;
  C3dBytes number_;
  bool is_unsigned_;
};

}  // namespace myoid::recording
