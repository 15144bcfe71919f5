#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/recording/tables/text_rows.h"

namespace myoid::recording {

struct StorageFormat {
  std::string title = "Storage";
  bool angles_in_degrees = false;     ///< Writes radians as degrees; the header says so.
  bool in_si = true;                  ///< The header states S.I. units; false if the units are unknown.
  std::vector<std::string> comments;  ///< Lines of free text in the header (provenance).
};

/// Returns the text of a version 1 storage file, as OpenSim, its GUI, CEINMS and pandas read it: title, version=1,
/// nRows, nColumns (time included), inDegrees, comments, endheader, labels, rows. Cells are separated by tabs; every
/// number is the shortest text that reads back to the same value. Throws InvalidInput if a value is not finite.
[[nodiscard]] std::string format_storage(const TimeSeries& series, const StorageFormat& format);

/// Writes this text to a file, completely or not at all.
void write_storage(const std::filesystem::path& path, const TimeSeries& series, const StorageFormat& format);
/// Writes such a file of rows that are asked for block by block. Throws InvalidInput, naming channel and time, for the
/// first row with a value that is not finite.
void write_storage(const std::filesystem::path& path, const RowSource& source, const StorageFormat& format);

/// Writes a plain table: lines "# remark", a header line "time_s,name [unit],..." (no brackets
/// without a unit) and the numbers. Gaps become empty cells.
void write_csv(const std::filesystem::path& path,
               const TimeSeries& series,
               const std::vector<std::string>& remarks = {});
void write_csv(const std::filesystem::path& path,
               const RowSource& source,
               const std::vector<std::string>& remarks = {});

}  // namespace myoid::recording
