#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// A .mot or .sto file. The numbers carry no unit yet, because only the caller knows which columns are angles.
struct Storage {
  std::string title;                          ///< First line of the header, if it is free text.
  std::map<std::string, std::string> header;  ///< key=value pairs.
  std::map<std::string, std::string> units;   ///< From lines "channel NAME [unit]".
  bool in_degrees = false;                    ///< By `inDegrees=yes`, or a .mot of the old SIMM kind.
  TimeSeries data;  ///< Channels without dimension; Vec3 columns are `name_1`, `name_2`, `name_3`.
  std::vector<Repair> repairs;
};

/// Reads all dialects: SIMM (datacolumns/datarows), version 1 (nRows/nColumns), versions 2 and 3 (DataType, element
/// types with comma-separated numbers). Repairs with a note: CRLF, byte-order mark, `Time`, row or column counts that
/// disagree with the header, trailing tabs, blank rows, decimal commas, repeated rows of one time, columns that share a
/// name. Throws ReadError with the line when there is no `endheader`, a row has too few numbers, a cell is no number or
/// is empty beside surplus cells, time goes backwards, or `inDegrees` is neither yes nor no.
[[nodiscard]] Storage read_storage(const std::filesystem::path& path);
[[nodiscard]] Storage parse_storage(std::string_view text, const std::filesystem::path& path);

/// Converts to SI: columns for which `is_angle` holds become radians (from degrees if the file says
/// so), all others get the unit `other`.
[[nodiscard]] TimeSeries to_si(const Storage& storage,
                               const std::function<bool(const std::string&)>& is_angle,
                               Unit other = Unit::meter);

}  // namespace myoid::recording
