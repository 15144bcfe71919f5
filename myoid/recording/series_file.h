#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// A series from a table or a storage file, with the notes of its reader.
struct SeriesFile {
  TimeSeries data;
  std::vector<Repair> repairs;
  std::vector<double> to_si = {};  ///< Of a table, for each column: the factor of the unit that is written, 0: none.
};

/// Reads a series from a table (.csv, .tsv, .txt) or a storage file (any other name), in the file's
/// units, or in SI where a table states them. Of a table with several clocks, the first is taken. Throws as
/// `parse_emg_table` and `read_storage`.
[[nodiscard]] SeriesFile read_series(const std::filesystem::path& path);

/// Writes a series in the format of the file's extension. A .csv becomes a table ("name [V]" in the
/// header row, the remarks above as lines "# ..."); a .sto or .mot becomes a storage file of this
/// title with the remarks in its header. Throws InvalidInput for other extensions.
void write_series(const std::filesystem::path& path,
                  const TimeSeries& series,
                  const std::string& title,
                  const std::vector<std::string>& remarks = {});

}  // namespace myoid::recording
