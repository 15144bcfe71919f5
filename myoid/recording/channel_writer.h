#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/tables/text_rows.h"

namespace myoid::recording {

/// The statements of a file about its numbers beside the names of their columns.
struct ChannelStatement {
  std::string title;               ///< Title of a storage file.
  bool in_degrees = false;         ///< Angles are in degrees; which columns is not stated.
  std::vector<std::string> units;  ///< As written, one for each column; empty if unknown.
};

/// Returns the statements of a storage file, whose numbers stay unchanged: units from lines
/// "channel NAME [unit]" or, for all columns, a voltage (stated_voltage).
[[nodiscard]] ChannelStatement statement_of(const Storage& file);

/// Returns the statements about channels that were read from a file in SI. A table may have
/// write_channels' remark on degrees.
[[nodiscard]] ChannelStatement statement_of(const std::vector<Channel>& channels, const std::filesystem::path& file);

/// Writes channels with their statements, so that reading gives the same again. A .csv has units in
/// its header cells and, for degrees, the remark "# inDegrees=yes". A storage file has its title,
/// inDegrees and units: "unit=uV" where all columns have one voltage, else "channel NAME [unit]";
/// its header states S.I. units only where all are. The numbers are written unchanged.
void write_channels(const std::filesystem::path& out, RowSource rows, const ChannelStatement& said);

}  // namespace myoid::recording
