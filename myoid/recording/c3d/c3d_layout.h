#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "myoid/recording/c3d/c3d_file.h"
#include "myoid/recording/c3d/c3d_header.h"

namespace myoid::recording {

/// Place, number and kind of the samples.
struct C3dLayout {
  std::uint64_t data_offset = 0;
  bool integer = false;
  float scale = 1.0F;  ///< Scale of integer coordinates.
  std::size_t points = 0;
  std::size_t channels = 0;
  std::size_t analog_per_frame = 1;
  std::int64_t frames = 0;
  std::int64_t first_frame = 1;

  [[nodiscard]] std::uint64_t frame_bytes() const {
    return (4 * points + channels * analog_per_frame) * (integer ? 2U : 4U);
  }
};

/// Finds the layout on which header, parameters and file size agree, by the rules of `read_c3d_head`.
/// Throws ReadError where they cannot be reconciled.
[[nodiscard]] C3dLayout find_c3d_layout(const C3dHeader& header,
                                        const C3dFile& parameters,
                                        std::uint64_t file_size,
                                        const std::filesystem::path& path,
                                        std::vector<Repair>& repairs);

}  // namespace myoid::recording
