#pragma once

#include <string>

#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/recording.h"

#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::test {

/// Writes a C3D file and reads it as a recording.
inline recording::Recording from_disk(const recording::C3dFile& file) {
  const TemporaryFolder folder;
  recording::write_c3d(folder / "plate.c3d", file);
  return recording::read_recording(folder / "plate.c3d");
}

inline recording::Recording from_disk(const PlateCase& plate) { return from_disk(plate_recording(plate)); }

/// The notes of the reader, a line each.
inline std::string notes_of(const recording::Recording& recording) {
  std::string all;
  for (const Repair& repair : recording.repairs) all += repair.message + "\n";
  return all;
}

}  // namespace myoid::test
