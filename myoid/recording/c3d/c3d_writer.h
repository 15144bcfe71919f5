#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::recording {

struct C3dFormat {
  C3dProcessor processor = C3dProcessor::intel;
  /// Writes 16-bit samples instead of reals; coordinates have steps of `point_scale`.
  bool integer = false;
};

/// Returns the bytes of a C3D file: header, parameters from block 2, data from the next whole block. The groups of
/// `file` are kept; parameters that describe the data (USED, RATE, SCALE, LABELS, ...) follow from its values, and
/// required groups and parameters are added. Counts beyond 16 bits go to POINT:LONG_FRAMES and
/// TRIAL:ACTUAL_START_FIELD, names beyond the 255th to LABELS2 and so on, events beyond the 255th to EVENT:TIMES2,
/// LABELS2 and so on. Reals keep every bit, so that reading gives the same file; a position that is no number becomes a
/// missing one. Throws InvalidInput if the format cannot hold a value: more than 65535 points or analog samples a
/// frame, an integer sample that is out of range or has a fraction, a name of more than 255 bytes.
[[nodiscard]] std::vector<std::byte> format_c3d(const C3dFile& file, const C3dFormat& format = {});

/// Writes these bytes to a file, completely or not at all.
void write_c3d(const std::filesystem::path& path, const C3dFile& file, const C3dFormat& format = {});

}  // namespace myoid::recording
