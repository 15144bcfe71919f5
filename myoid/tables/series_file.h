#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {

/// A series of either kind of file, and what its reader mended or left out.
struct SeriesFile {
  TimeSeries data;
  std::vector<Repair> repairs;
};

/// A series from a table (.csv, .tsv, .txt) or a storage file (any other name), units as the file
/// gives them. Throws as `read_csv_series` and `read_storage`.
[[nodiscard]] SeriesFile read_series(const std::filesystem::path& path);

/// Writes a series in the format that the file's name asks for: .csv a table ("name [V]" in the
/// header row, the remarks before it as lines "# ..."), .sto or .mot a storage file of this title
/// with the remarks in its header. Throws InvalidInput for other names.
void write_series(const std::filesystem::path& path,
                  const TimeSeries& series,
                  const std::string& title,
                  const std::vector<std::string>& remarks = {});

}  // namespace myoid::recording
