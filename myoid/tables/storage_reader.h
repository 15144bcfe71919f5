#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {

/// A .mot or .sto file: numbers as written, no unit attached yet, since only the caller knows which
/// columns are angles.
struct Storage {
  std::string title;                          ///< First line of the header, if it is free text.
  std::map<std::string, std::string> header;  ///< key=value pairs.
  std::map<std::string, std::string> units;   ///< Of columns with a line "channel NAME [unit]".
  bool in_degrees =
      false;        ///< Said by the header (`inDegrees=yes`), or a .mot of the old SIMM kind.
  TimeSeries data;  ///< Dimensionless channels; Vec3 columns are `name_1`, `name_2`, `name_3`.
  std::vector<Repair> repairs;
};

/// Reads all dialects: SIMM (datacolumns/datarows), version 1 (nRows/nColumns), versions 2 and 3
/// (DataType, element types with comma-separated numbers). Mended with a note: CRLF, byte-order
/// mark, `Time`, row or column counts that disagree with the header, trailing tabs, blank rows,
/// comma decimals, repeated rows of one time, columns of one name. Throws ReadError with the line
/// when there is no `endheader`, a row has too few numbers, a cell is no number or is empty beside
/// surplus ones, time goes backwards, or `inDegrees` is neither yes nor no.
[[nodiscard]] Storage read_storage(const std::filesystem::path& path);
[[nodiscard]] Storage parse_storage(std::string_view text, const std::filesystem::path& path);

/// The file's numbers as SI: columns for which `is_angle` holds become radians (converted if the
/// file is in degrees), all others get `other`.
[[nodiscard]] TimeSeries to_si(const Storage& storage,
                               const std::function<bool(const std::string&)>& is_angle,
                               Unit other = Unit::meter);

}  // namespace myoid::recording
