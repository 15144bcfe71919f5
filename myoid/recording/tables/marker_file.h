#pragma once

#include <string>
#include <vector>

#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// A coordinate beyond is no measurement [m]: 1000 km.
inline constexpr double kFarthest_m = 1e6;

/// Markers of a file, in meters.
struct MarkerFile {
  MarkerSeries markers;
  std::string unit;  ///< As written.
  std::vector<Repair> repairs;
};

}  // namespace myoid::recording
