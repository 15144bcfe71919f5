#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "myoid/ground/files/byte_source.h"
#include "myoid/recording/c3d/c3d_file.h"
#include "myoid/recording/c3d/c3d_frames.h"
#include "myoid/recording/c3d/c3d_layout.h"

namespace myoid::recording {

/// A C3D file without its samples, and the place of these.
struct C3dHead {
  C3dFile file;  ///< `points` and `analog` are empty.
  C3dLayout layout;
  bool is_unsigned = false;

  [[nodiscard]] C3dFrames frames() const { return {layout, file.processor, is_unsigned}; }
};

/// Reads all of a .c3d file but its samples: Intel, DEC and SGI, integers and reals, parameters and data at any block,
/// LABELS2 and so on, unsigned samples, more than 65535 frames (POINT:LONG_FRAMES, TRIAL:ACTUAL_START_FIELD). Where
/// header and parameters disagree, the size of the file decides. Repairs are noted with the parameter, byte or frame:
/// counts, rates and scales that disagree, a damaged end of the parameter section, a missing section (the header then
/// tells the processor), missing or repeated labels, a last frame that is cut off. Data of a ROTATION group are left
/// out, with a note. Throws ReadError if the file is no C3D file, if the counts cannot be reconciled, or if there is no
/// rate or no whole frame.
[[nodiscard]] C3dHead read_c3d_head(ByteSource& source, const std::filesystem::path& path);

/// Reads a file whole, its samples as stored: a frame of reals is copied bit by bit. Throws like `read_c3d_head`.
[[nodiscard]] C3dFile read_c3d_source(ByteSource& source, const std::filesystem::path& path);
[[nodiscard]] C3dFile read_c3d(const std::filesystem::path& path);

}  // namespace myoid::recording
