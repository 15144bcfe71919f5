#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"

namespace myoid::recording {

struct StorageFormat {
  std::string title = "Storage";
  bool angles_in_degrees =
      false;          ///< Columns in radians are written in degrees, and the header says so.
  bool in_si = true;  ///< The header says that the units are S.I.; false where they are not known.
  std::vector<std::string> comments;  ///< Lines of free text in the header (provenance).
};

/// Text of a version 1 storage file, as OpenSim, its GUI, CEINMS and pandas read it: title,
/// version=1, nRows, nColumns (time included), inDegrees, comments, endheader, labels, rows; tabs;
/// every number the shortest text that reads back the same. Throws InvalidInput if a value is not
/// finite.
[[nodiscard]] std::string format_storage(const TimeSeries& series, const StorageFormat& format);

/// Writes it, whole or not at all.
void write_storage(const std::filesystem::path& path,
                   const TimeSeries& series,
                   const StorageFormat& format);

/// A plain table: lines "# remark", a header line "time_s,name [unit],..." (no unit where there is
/// none) and the numbers; gaps are empty cells.
void write_csv(const std::filesystem::path& path,
               const TimeSeries& series,
               const std::vector<std::string>& remarks = {});

}  // namespace myoid::recording
