#include "myoid/recording/tables/storage_header.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"

namespace myoid::recording {
namespace {

using Pair = std::pair<std::string, std::string>;

/// A header is short: the search for `endheader` stops here.
constexpr std::size_t kMostLines = 2000;

/// Returns the value of a header key, ignoring case.
const std::string* value_of(const std::map<std::string, std::string>& header, std::string_view key) {
  for (const auto& [name, value] : header) {
    if (equal_ignoring_case(name, key)) return &value;
  }
  return nullptr;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view w) { return equal_ignoring_case(w, word); });
}

/// Splits "key=value", "key = value", and for the keys of the old kind "key value"; empty if the line is free text.
std::optional<Pair> key_and_value(std::string_view line) {
  const std::size_t equal = line.find('=');
  if (equal != std::string_view::npos) {
    const std::string_view key = trim(line.substr(0, equal));
    if (key.empty() || split_words(key).size() != 1) return std::nullopt;
    return Pair(key, trim(line.substr(equal + 1)));
  }
  const auto words = split_words(line);
  if (words.size() != 2 ||
      !is_one_of(words[0], {"datacolumns", "datarows", "name", "nRows", "nColumns", "inDegrees", "version"})) {
    return std::nullopt;
  }
  return Pair(words[0], words[1]);
}

/// Returns NAME and unit of a line "channel NAME [unit]".
std::optional<Pair> channel_unit(std::string_view line) {
  constexpr std::string_view kStart = "channel ";
  const std::size_t open = line.rfind('[');
  if (!line.starts_with(kStart) || !line.ends_with(']') || open == std::string_view::npos || open < kStart.size())
    return std::nullopt;
  const std::string_view name = trim(line.substr(kStart.size(), open - kStart.size()));
  const std::string_view unit = trim(line.substr(open + 1, line.size() - open - 2));
  if (name.empty() || unit.empty()) return std::nullopt;
  return Pair(name, unit);
}

/// Returns a line without the separators and quotes that a spreadsheet puts around its text.
std::string_view without_empty_cells(std::string_view line) {
  line = trim(line);
  while (!line.empty() && std::string_view(",; \t\r\"").find(line.back()) != std::string_view::npos)
    line.remove_suffix(1);
  while (line.starts_with('"')) line.remove_prefix(1);
  return line;
}

bool yes_or_no(const std::string& value, const std::filesystem::path& path, std::size_t line) {
  if (is_one_of(value, {"yes", "y", "true", "1"})) return true;
  if (is_one_of(value, {"no", "n", "false", "0"})) return false;
  throw ReadError(path, line, fmt::format("inDegrees: found '{}', expected yes or no", value));
}

std::size_t elements_of(const std::map<std::string, std::string>& keys) {
  const std::string* type = value_of(keys, "DataType");
  if (type == nullptr) return 1;
  return is_one_of(*type, {"Vec3", "UnitVec3"})     ? 3
         : is_one_of(*type, {"Vec2"})               ? 2
         : is_one_of(*type, {"Quaternion", "Vec4"}) ? 4
         : is_one_of(*type, {"Vec6", "SpatialVec"}) ? 6
                                                    : 1;
}

[[noreturn]] void refuse_without_end(const std::filesystem::path& path) {
  const std::string other = wrong_kind(path, {FileFormat::storage}, "a time series (.mot, .sto)");
  if (!other.empty()) throw ReadError(path, 0, other);
  throw ReadError(path, 0,
                  "no line 'endheader': this is not a .mot or .sto file, or it is cut off; for a plain table use .csv");
}

}  // namespace

std::optional<double> StorageHeader::count(std::initializer_list<const char*> names) const {
  for (const char* name : names) {
    if (const std::string* text = value_of(file.header, name)) {
      if (const auto value = parse_number(*text)) return value;
    }
  }
  return std::nullopt;
}

StorageHeader read_storage_header(const std::vector<std::string_view>& lines, const std::filesystem::path& path) {
  StorageHeader header;
  const std::size_t most = std::min(lines.size(), kMostLines);
  for (std::size_t line = 0;; ++line) {
    if (line == most) refuse_without_end(path);
    const std::string_view content = without_empty_cells(lines[line]);
    if (equal_ignoring_case(content, "endheader")) {
      header.end = line;
      break;
    }
    if (auto channel = channel_unit(content); channel && line > 0) {
      header.file.units.insert(std::move(*channel));
    } else if (const auto pair = key_and_value(content)) {
      const auto& [key, value] = *pair;
      header.file.header[key] = value;
      if (equal_ignoring_case(key, "inDegrees")) header.file.in_degrees = yes_or_no(value, path, line + 1);
    } else if (line == 0) {
      header.file.title = std::string(content);
    }
  }
  if (value_of(header.file.header, "inDegrees") == nullptr && extension_of(path) == ".mot" &&
      header.count({"version"}).value_or(0.0) < 1.0) {
    header.file.in_degrees = true;
    header.file.repairs.push_back({0, "no version in the header: taken as SIMM's kind, angles in degrees"});
  }
  header.elements = elements_of(header.file.header);
  return header;
}

}  // namespace myoid::recording
