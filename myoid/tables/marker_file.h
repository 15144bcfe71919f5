#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/files/marker_series.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {

/// Markers of a file, in meters.
struct MarkerFile {
  MarkerSeries markers;
  std::string unit;  ///< As written.
  std::vector<Repair> repairs;
  std::optional<Vec3> screen_up_L;  ///< As in `Recording`.
};

}  // namespace myoid::recording
