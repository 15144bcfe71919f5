#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/tables/storage_reader.h"
#include "myoid/tables/text_rows.h"

namespace myoid::recording {

/// What a file says of its numbers beside the names of their columns.
struct ChannelStatement {
  std::string title;  ///< Of a storage file.
  bool in_degrees =
      false;  ///< Its angles are in degrees; which columns are angles it does not say.
  std::vector<std::string> units;  ///< As written, a column each; empty where it is not known.
};

/// Of a storage file, whose numbers stay as they are: units from lines "channel NAME [unit]" or,
/// for all columns, a voltage (stated_voltage).
[[nodiscard]] ChannelStatement statement_of(const Storage& file);

/// Of channels that were read from a file in SI. A table may have the remark of write_channels on
/// degrees.
[[nodiscard]] ChannelStatement statement_of(const std::vector<Channel>& channels,
                                            const std::filesystem::path& file);

/// Writes channels with what was said of them, so that reading brings back the same: a .csv with
/// units in its header cells and, if so, the remark "# inDegrees=yes", or a storage file with its
/// title, inDegrees and units: "unit=uV" where all columns have one voltage, else "channel NAME
/// [unit]". It says that the units are S.I. only where all of them are. The numbers are written as
/// they are.
void write_channels(const std::filesystem::path& out, RowSource rows, const ChannelStatement& said);

}  // namespace myoid::recording
