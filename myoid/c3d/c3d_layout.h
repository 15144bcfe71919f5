#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "myoid/c3d/c3d_bytes.h"
#include "myoid/c3d/c3d_file.h"

namespace myoid::recording {

/// What the first 512 bytes of a C3D file say.
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

/// The processor under which the header makes sense, where no parameter section says it.
[[nodiscard]] std::optional<C3dProcessor> guess_processor(std::span<const std::byte> head,
                                                          std::uint64_t file_size);

/// Where the samples stand and how many there are.
struct C3dLayout {
  std::uint64_t data_offset = 0;
  bool integer = false;
  float scale = 1.0F;  ///< Of integer coordinates.
  std::size_t points = 0;
  std::size_t channels = 0;
  std::size_t analog_per_frame = 1;
  std::int64_t frames = 0;
  std::int64_t first_frame = 1;

  [[nodiscard]] std::uint64_t frame_bytes() const {
    return (4 * points + channels * analog_per_frame) * (integer ? 2U : 4U);
  }
};

/// The layout that header, parameters and file size agree on, by the rules of `read_c3d`. Throws
/// ReadError where they cannot be reconciled.
[[nodiscard]] C3dLayout find_c3d_layout(const C3dHeader& header,
                                        const C3dFile& parameters,
                                        std::uint64_t file_size,
                                        const std::filesystem::path& path,
                                        std::vector<Repair>& repairs);

}  // namespace myoid::recording
