#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "myoid/recording/c3d/c3d_bytes.h"

namespace myoid::recording {

/// The first 512 bytes of a C3D file.
struct C3dHeader {
  std::size_t points = 0;        ///< Word 2.
  std::size_t analog_total = 0;  ///< Word 3: samples of all channels in a frame.
  std::int64_t first_frame = 1;  ///< Words 4 and 5.
  std::int64_t last_frame = 0;
  float scale = 0.0F;                ///< Words 7, 8; negative: samples are reals.
  std::size_t data_block = 0;        ///< Word 9, counted from 1.
  std::size_t analog_per_frame = 0;  ///< Word 10.
  float rate_hz = 0.0F;              ///< Words 11, 12.
};

[[nodiscard]] C3dHeader read_c3d_header(std::span<const std::byte> head, const C3dBytes& number);

/// Returns true for a rate in Hz that a recording can have.
[[nodiscard]] bool is_c3d_rate(double rate_hz);

/// Returns the processor under which the header makes sense, for a file without a parameter section.
[[nodiscard]] std::optional<C3dProcessor> guess_processor(std::span<const std::byte> head, std::uint64_t file_size);

}  // namespace myoid::recording
