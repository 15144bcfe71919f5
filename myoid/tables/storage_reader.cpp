#include "myoid/tables/storage_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/files/file_format.h"

namespace myoid::recording {
namespace {

enum class Cell { number, none, wrong };

enum class Before { blank, comma };

/// Reads the next number of a row; moves `at` behind it. Tabs and blanks separate cells, a comma
/// the elements of one cell.
Cell next_number(const char*& at, const char* end, Before before, bool elements, double& value) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (at != end && is_blank(*at)) ++at;
  if (before == Before::comma) {
    if (at == end || *at != ',') return at == end ? Cell::none : Cell::wrong;
    for (++at; at != end && is_blank(*at);) ++at;
  }
  if (at == end) return Cell::none;
  const char* begin = *at == '+' && at + 1 != end && at[1] != '-' ? at + 1 : at;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) {
    const auto tiny = parse_number(
        {begin, static_cast<std::size_t>(stop - begin)});  // 0 below the smallest double
    if (!tiny) return Cell::wrong;
    value = *tiny;
  } else if (error != std::errc()) {
    return Cell::wrong;
  }
  if (stop != end && !is_blank(*stop) && !(elements && *stop == ',')) return Cell::wrong;
  at = stop;
  return Cell::number;
}

std::string_view word_at(const char* at, const char* end) {
  const char* stop = at;
  while (stop != end && *stop != '\t' && *stop != ' ') ++stop;
  return {at, static_cast<std::size_t>(stop - at)};
}

/// The value of a header key, whatever its case.
const std::string* value_of(const std::map<std::string, std::string>& header,
                            std::string_view key) {
  for (const auto& [name, value] : header) {
    if (equal_ignoring_case(name, key)) return &value;
  }
  return nullptr;
}

std::optional<double> count_of(const std::map<std::string, std::string>& header,
                               std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const std::string* text = value_of(header, key)) {
      if (const auto value = parse_number(*text)) return value;
    }
  }
  return std::nullopt;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view w) { return equal_ignoring_case(w, word); });
}

/// "key=value", "key = value", and "key value" for the keys of the old kind; empty if the line is
/// free text.
std::optional<std::pair<std::string, std::string>> key_and_value(std::string_view line) {
  const std::size_t equal = line.find('=');
  if (equal != std::string_view::npos) {
    const std::string_view key = trim(line.substr(0, equal));
    if (key.empty() || split_words(key).size() != 1) return std::nullopt;
    return std::pair(std::string(key), std::string(trim(line.substr(equal + 1))));
  }
  const auto words = split_words(line);
  if (words.size() != 2 || !is_one_of(words[0], {"datacolumns", "datarows", "name", "nRows",
                                                 "nColumns", "inDegrees", "version"})) {
    return std::nullopt;
  }
  return std::pair(std::string(words[0]), std::string(words[1]));
}

/// NAME and unit of a line "channel NAME [unit]".
std::optional<std::pair<std::string, std::string>> channel_unit(std::string_view line) {
  constexpr std::string_view kStart = "channel ";
  const std::size_t open = line.rfind('[');
  if (!line.starts_with(kStart) || !line.ends_with(']') || open == std::string_view::npos ||
      open < kStart.size())
    return std::nullopt;
  const std::string_view name = trim(line.substr(kStart.size(), open - kStart.size()));
  const std::string_view unit = trim(line.substr(open + 1, line.size() - open - 2));
  if (name.empty() || unit.empty()) return std::nullopt;
  return std::pair(std::string(name), std::string(unit));
}

/// Comma decimals: "1,5<tab>2,25" without any decimal point. Only when the file has one number a
/// cell.
bool looks_like_comma_decimals(std::string_view line) {
  return line.find(',') != std::string_view::npos && line.find('.') == std::string_view::npos;
}

/// Labels as other programs write them, with commas between: no tab, and more cells than words.
bool are_comma_labels(std::string_view line) {
  return line.find('\t') == std::string_view::npos &&
         split(line, ',').size() >= std::max<std::size_t>(2, split_words(line).size());
}

/// A row of `width` numbers with commas between them.
bool is_comma_row(std::string_view line, std::size_t width) {
  if (line.find('\t') != std::string_view::npos) return false;
  const auto cells = split(line, ',');
  return width > 1 && cells.size() == width &&
         std::all_of(cells.begin(), cells.end(),
                     [](std::string_view cell) { return parse_number(cell).has_value(); });
}

}  // namespace

Storage parse_storage(std::string_view text, const std::filesystem::path& path) {
  const std::vector<std::string_view> lines = split_lines(text);
  if (lines.empty()) throw ReadError(path, 0, "the file has no lines; export it again");
  Storage storage;
  std::size_t line = 0;
  bool found = false;
  for (; line < lines.size(); ++line) {
    const std::string_view content = trim(lines[line]);
    if (equal_ignoring_case(content, "endheader")) {
      found = true;
      break;
    }
    if (auto channel = channel_unit(content); channel && line > 0) {
      storage.units.insert(std::move(*channel));
    } else if (const auto pair = key_and_value(content)) {
      storage.header[pair->first] = pair->second;
      if (equal_ignoring_case(pair->first, "inDegrees")) {
        storage.in_degrees = is_one_of(pair->second, {"yes", "y", "true", "1"});
        if (!storage.in_degrees && !is_one_of(pair->second, {"no", "n", "false", "0"})) {
          throw ReadError(path, line + 1,
                          fmt::format("inDegrees: found '{}', expected yes or no", pair->second));
        }
      }
    } else if (line == 0) {
      storage.title = std::string(content);
    }
    if (line > 2000) break;
  }
  if (!found) {
    const std::string other = wrong_kind(path, {FileFormat::storage}, "a time series (.mot, .sto)");
    if (!other.empty()) throw ReadError(path, 0, other);
    throw ReadError(path, 0,
                    "no line 'endheader': this is not a .mot or .sto file, or it is cut off; for a "
                    "plain table use .csv");
  }
  if (value_of(storage.header, "inDegrees") == nullptr &&
      equal_ignoring_case(path.extension().string(), ".mot") &&
      count_of(storage.header, {"version"}).value_or(0.0) < 1.0) {
    storage.in_degrees = true;
    storage.repairs.push_back(
        {0, "no version in the header: taken as SIMM's kind, angles in degrees"});
  }
  std::size_t elements = 1;
  if (const std::string* type = value_of(storage.header, "DataType")) {
    elements = is_one_of(*type, {"Vec3", "UnitVec3"})     ? 3
               : is_one_of(*type, {"Vec2"})               ? 2
               : is_one_of(*type, {"Quaternion", "Vec4"}) ? 4
               : is_one_of(*type, {"Vec6", "SpatialVec"}) ? 6
                                                          : 1;
  }

  // Column labels.
  do ++line;
  while (line < lines.size() && trim(lines[line]).empty());
  if (line >= lines.size())
    throw ReadError(path, line, "the file ends after its header: expected the column labels");
  std::vector<std::string> names;
  const std::size_t label_line = line + 1;
  const bool tabbed = lines[line].find('\t') != std::string_view::npos;
  bool comma_cells = elements == 1 && are_comma_labels(lines[line]);
  for (const std::string_view label : tabbed        ? split(trim(lines[line]), '\t')
                                      : comma_cells ? split(trim(lines[line]), ',')
                                                    : split_words(lines[line])) {
    names.emplace_back(trim(label));
  }
  while (!names.empty() && names.back().empty()) names.pop_back();
  if (names.empty() || !equal_ignoring_case(names[0], "time")) {
    throw ReadError(path, label_line,
                    fmt::format("expected the first column to be 'time', found '{}'",
                                names.empty() ? "" : names[0]));
  }
  if (names[0] != "time")
    storage.repairs.push_back({label_line, fmt::format("column '{}' read as 'time'", names[0])});
  std::vector<Channel> channels;
  std::set<std::string> seen;
  for (std::size_t c = 1; c < names.size(); ++c) {
    std::string name = names[c].empty() ? fmt::format("column_{}", c + 1) : names[c];
    for (int k = 2; !seen.insert(name).second; ++k) {
      const std::string other = fmt::format("{}_{}", names[c], k);
      storage.repairs.push_back(
          {label_line,
           fmt::format("two columns are named '{}'; the later one is '{}' here", names[c], other)});
      name = other;
    }
    if (elements == 1) {
      channels.push_back({name, Unit::dimensionless});
    } else {
      for (std::size_t e = 1; e <= elements; ++e)
        channels.push_back({fmt::format("{}_{}", name, e), Unit::dimensionless});
    }
  }
  const std::size_t width = channels.size() + 1;
  if (const auto said = count_of(storage.header, {"nColumns", "datacolumns"});
      said && *said != static_cast<double>(names.size()) && elements == 1) {
    storage.repairs.push_back(
        {0, fmt::format("the header says {} columns, there are {}", *said, names.size())});
  }

  // Rows.
  const std::size_t most =
      std::min(lines.size() - line - 1,
               text.size() / (2 * width - 1) + 1);  // a number and a separator per cell
  std::vector<double> time;
  Eigen::MatrixXd values(static_cast<Eigen::Index>(most), static_cast<Eigen::Index>(width - 1));
  std::vector<double> row(width);
  std::size_t repeated = 0;
  std::size_t extra_line = 0;
  std::size_t nan_line = 0;
  std::size_t comma_line = 0;
  std::size_t doubled_line = 0;
  std::string mended;
  const auto rows_said = count_of(storage.header, {"nRows", "datarows"});
  while (line + 1 < lines.size() && trim(lines[line + 1]).empty()) ++line;
  if (elements == 1 && line + 1 < lines.size() && is_comma_row(lines[line + 1], width))
    comma_cells = true;
  if (comma_cells) storage.repairs.push_back({label_line, "separated by commas instead of tabs"});
  for (++line; line < lines.size(); ++line) {
    std::string_view content = lines[line];
    if (trim(content).empty()) continue;
    if (line + 1 == lines.size() && !ends_with_line(text)) {
      const bool complete = rows_said &&
                            *rows_said == static_cast<double>(time.size() + repeated + 1) &&
                            !looks_cut(content, lines[line - 1]);
      if (!complete && !time.empty()) {
        storage.repairs.push_back({line + 1, std::string(kLastRowLeftOut)});
        break;
      }
      storage.repairs.push_back({line + 1, std::string(kLastRowKept)});
    }
    if (comma_cells || (elements == 1 && looks_like_comma_decimals(content))) {
      mended.assign(content);
      std::replace(mended.begin(), mended.end(), ',', comma_cells ? '\t' : '.');
      content = mended;
      if (!comma_cells && comma_line == 0) comma_line = line + 1;
    }
    const char* at = content.data();
    const char* const end = at + content.size();
    for (std::size_t c = 0; c < width; ++c) {
      double value = 0.0;
      const Cell cell =
          next_number(at, end, c > 0 && (c - 1) % elements != 0 ? Before::comma : Before::blank,
                      elements > 1, value);
      if (cell == Cell::none) {
        throw ReadError(
            path, line + 1,
            fmt::format("expected {} numbers, found {}; the row is cut off or a cell is empty",
                        width, c));
      }
      if (cell == Cell::wrong) {
        throw ReadError(path, line + 1,
                        fmt::format("expected a number in column {} ('{}'), found '{}'", c + 1,
                                    c == 0 ? "time" : channels[c - 1].name, word_at(at, end)));
      }
      if (!std::isfinite(value)) {
        if (c == 0) throw ReadError(path, line + 1, "the time is not a number");
        if (nan_line == 0) nan_line = line + 1;
        value = std::numeric_limits<double>::quiet_NaN();
      }
      row[c] = value;
    }
    const bool doubled =
        trim({content.data(), static_cast<std::size_t>(at - content.data())}).find("\t\t") !=
        std::string_view::npos;
    if (doubled && doubled_line == 0) doubled_line = line + 1;
    if (!trim({at, static_cast<std::size_t>(end - at)}).empty()) {
      if (comma_cells)
        throw ReadError(path, line + 1,
                        fmt::format("more than {} numbers; decimal commas in a file separated by "
                                    "commas?",
                                    width));
      if (doubled) {
        throw ReadError(path, line + 1,
                        fmt::format("a cell is empty and there are more than {} numbers: which "
                                    "belongs to which column?",
                                    width));
      }
      if (extra_line == 0) extra_line = line + 1;
    }
    // Times that differ by their rounding alone are one.
    constexpr double kSameTime_s = 1e-10;
    if (!time.empty() && row[0] <= time.back() + kSameTime_s) {
      if (row[0] < time.back() - kSameTime_s) {
        throw ReadError(
            path, line + 1,
            fmt::format("time goes backwards: {} s after {} s; sort the rows or split the file",
                        row[0], time.back()));
      }
      if (++repeated == 1)
        storage.repairs.push_back(
            {line + 1, fmt::format("the time {} s stands twice; the first row is kept", row[0])});
      continue;
    }
    const auto index = static_cast<Eigen::Index>(time.size());
    time.push_back(row[0]);
    for (std::size_t c = 1; c < width; ++c)
      values(index, static_cast<Eigen::Index>(c - 1)) = row[c];
  }
  if (time.empty())
    throw ReadError(path, 0, "there are no rows of numbers after the column labels");
  if (repeated > 1)
    storage.repairs.push_back(
        {0, fmt::format("{} rows in all repeat a time and were dropped", repeated)});
  if (comma_line > 0)
    storage.repairs.push_back({comma_line, "comma decimals read as decimal points"});
  if (doubled_line > 0)
    storage.repairs.push_back(
        {doubled_line,
         "two tabs in a row taken as one, since the numbers are as many as the columns"});
  if (extra_line > 0)
    storage.repairs.push_back({extra_line, "more numbers than columns; the surplus is ignored"});
  if (nan_line > 0) storage.repairs.push_back({nan_line, "a value is not a number; kept as a gap"});
  if (rows_said && *rows_said != static_cast<double>(time.size() + repeated)) {
    storage.repairs.push_back({0, fmt::format("the header says {} rows, there are {}", *rows_said,
                                              time.size() + repeated)});
  }
  const auto count = static_cast<Eigen::Index>(time.size());
  values.conservativeResize(count, Eigen::NoChange);
  storage.data = TimeSeries(Eigen::Map<const Eigen::VectorXd>(time.data(), count),
                            std::move(channels), std::move(values));
  return storage;
}

Storage read_storage(const std::filesystem::path& path) {
  return parse_storage(read_text_file(path), path);
}

TimeSeries to_si(const Storage& storage,
                 const std::function<bool(const std::string&)>& is_angle,
                 Unit other) {
  std::vector<Channel> channels = storage.data.channels();
  Eigen::MatrixXd values = storage.data.values();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (is_angle(channels[c].name)) {
      channels[c].unit = Unit::radian;
      if (storage.in_degrees) values.col(static_cast<Eigen::Index>(c)) *= kDegree;
    } else {
      channels[c].unit = other;
    }
  }
  return {storage.data.time_s(), std::move(channels), std::move(values)};
}

}  // namespace myoid::recording
