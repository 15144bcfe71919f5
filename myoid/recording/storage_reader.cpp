#include "myoid/recording/storage_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "myoid/core/error.h"

namespace myoid::recording {
namespace {

/// Reads the next number of a row; moves `at` behind it. Separators are tabs, blanks and commas between elements.
enum class Cell { number, none, wrong };

Cell next_number(const char*& at, const char* end, double& value) {
  while (at != end && (*at == ' ' || *at == '\t' || *at == ',')) ++at;
  if (at == end) return Cell::none;
  const char* begin = *at == '+' ? at + 1 : at;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) {
    value = 0.0;  // below the smallest double
  } else if (error != std::errc()) {
    return Cell::wrong;
  }
  if (stop != end && *stop != ' ' && *stop != '\t' && *stop != ',') return Cell::wrong;
  at = stop;
  return Cell::number;
}

std::string_view word_at(const char* at, const char* end) {
  const char* stop = at;
  while (stop != end && *stop != '\t' && *stop != ' ') ++stop;
  return {at, static_cast<std::size_t>(stop - at)};
}

std::optional<std::size_t> count_of(const std::map<std::string, std::string>& header, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const auto it = header.find(key);
    if (it == header.end()) continue;
    const auto value = parse_number(it->second);
    if (value && *value >= 0.0) return static_cast<std::size_t>(*value);
  }
  return std::nullopt;
}

/// Comma decimals: "1,5<tab>2,25" without any decimal point. Only when the file has one number a cell.
bool looks_like_comma_decimals(std::string_view line) {
  return line.find(',') != std::string_view::npos && line.find('.') == std::string_view::npos;
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
    const std::size_t equal = content.find('=');
    if (equal != std::string_view::npos && content.find(' ') > equal) {
      storage.header[std::string(trim(content.substr(0, equal)))] = std::string(trim(content.substr(equal + 1)));
    } else if (const auto words = split_words(content); words.size() == 2 && (words[0] == "datacolumns" || words[0] == "datarows" || words[0] == "name")) {
      storage.header[std::string(words[0])] = std::string(words[1]);
    } else if (line == 0) {
      storage.title = std::string(content);
    }
    if (line > 2000) break;
  }
  if (!found) {
    throw ReadError(path, 0, "no line 'endheader': this is not a .mot or .sto file, or it is cut off; for a plain table use .csv");
  }
  const auto degrees = storage.header.find("inDegrees");
  if (degrees != storage.header.end()) {
    storage.in_degrees = equal_ignoring_case(degrees->second, "yes") || equal_ignoring_case(degrees->second, "true");
  } else if (equal_ignoring_case(path.extension().string(), ".mot") && !storage.header.contains("version")) {
    storage.in_degrees = true;
    storage.repairs.push_back({0, "no version in the header: taken as SIMM's kind, angles in degrees"});
  }
  const auto type = storage.header.find("DataType");
  std::size_t elements = 1;
  if (type != storage.header.end()) {
    const std::string& word = type->second;
    elements = word == "Vec3" ? 3 : word == "Quaternion" ? 4 : word == "Vec6" || word == "SpatialVec" ? 6 : 1;
  }

  // Column labels.
  do ++line;
  while (line < lines.size() && trim(lines[line]).empty());
  if (line >= lines.size()) throw ReadError(path, line, "the file ends after its header: expected the column labels");
  std::vector<std::string> names;
  const std::size_t label_line = line + 1;
  const bool tabbed = lines[line].find('\t') != std::string_view::npos;
  for (const std::string_view label : tabbed ? split(trim(lines[line]), '\t') : split_words(lines[line])) {
    names.emplace_back(trim(label));
  }
  while (!names.empty() && names.back().empty()) names.pop_back();
  if (names.empty() || !equal_ignoring_case(names[0], "time")) {
    throw ReadError(path, label_line, fmt::format("expected the first column to be 'time', found '{}'", names.empty() ? "" : names[0]));
  }
  if (names[0] != "time") storage.repairs.push_back({label_line, fmt::format("column '{}' read as 'time'", names[0])});
  std::vector<Channel> channels;
  std::set<std::string> seen;
  for (std::size_t c = 1; c < names.size(); ++c) {
    std::string name = names[c].empty() ? fmt::format("column_{}", c + 1) : names[c];
    for (int k = 2; !seen.insert(name).second; ++k) {
      const std::string other = fmt::format("{}_{}", names[c], k);
      storage.repairs.push_back({label_line, fmt::format("two columns are named '{}'; the later one is '{}' here", names[c], other)});
      name = other;
    }
    if (elements == 1) {
      channels.push_back({name, Unit::dimensionless});
    } else {
      for (std::size_t e = 1; e <= elements; ++e) channels.push_back({fmt::format("{}_{}", name, e), Unit::dimensionless});
    }
  }
  const std::size_t width = channels.size() + 1;
  if (const auto said = count_of(storage.header, {"nColumns", "datacolumns"}); said && *said != names.size() && elements == 1) {
    storage.repairs.push_back({0, fmt::format("the header says {} columns, there are {}", *said, names.size())});
  }

  // Rows.
  const std::size_t most = lines.size() - line - 1;
  std::vector<double> time;
  Eigen::MatrixXd values(static_cast<Eigen::Index>(most), static_cast<Eigen::Index>(width - 1));
  std::vector<double> row(width);
  std::size_t repeated = 0;
  std::size_t extra_line = 0;
  std::size_t nan_line = 0;
  std::size_t comma_line = 0;
  std::string mended;
  for (++line; line < lines.size(); ++line) {
    std::string_view content = lines[line];
    if (trim(content).empty()) continue;
    if (elements == 1 && looks_like_comma_decimals(content)) {
      mended.assign(content);
      std::replace(mended.begin(), mended.end(), ',', '.');
      content = mended;
      if (comma_line == 0) comma_line = line + 1;
    }
    const char* at = content.data();
    const char* const end = at + content.size();
    for (std::size_t c = 0; c < width; ++c) {
      double value = 0.0;
      const Cell cell = next_number(at, end, value);
      if (cell == Cell::none) {
        throw ReadError(path, line + 1, fmt::format("expected {} numbers, found {}; the row is cut off or a cell is empty", width, c));
      }
      if (cell == Cell::wrong) {
        throw ReadError(path, line + 1, fmt::format("expected a number in column {} ('{}'), found '{}'", c + 1,
                                                    c == 0 ? "time" : channels[c - 1].name, word_at(at, end)));
      }
      if (!std::isfinite(value)) {
        if (c == 0) throw ReadError(path, line + 1, "the time is not a number");
        if (nan_line == 0) nan_line = line + 1;
        value = std::numeric_limits<double>::quiet_NaN();
      }
      row[c] = value;
    }
    if (!trim({at, static_cast<std::size_t>(end - at)}).empty() && extra_line == 0) extra_line = line + 1;
    if (!time.empty() && row[0] <= time.back()) {
      if (row[0] < time.back()) {
        throw ReadError(path, line + 1, fmt::format("time goes backwards: {} s after {} s; sort the rows or split the file", row[0], time.back()));
      }
      if (++repeated == 1) storage.repairs.push_back({line + 1, fmt::format("the time {} s stands twice; the first row is kept", row[0])});
      continue;
    }
    const auto index = static_cast<Eigen::Index>(time.size());
    time.push_back(row[0]);
    for (std::size_t c = 1; c < width; ++c) values(index, static_cast<Eigen::Index>(c - 1)) = row[c];
  }
  if (time.empty()) throw ReadError(path, 0, "there are no rows of numbers after the column labels");
  if (repeated > 1) storage.repairs.push_back({0, fmt::format("{} rows in all repeat a time and were dropped", repeated)});
  if (comma_line > 0) storage.repairs.push_back({comma_line, "comma decimals read as decimal points"});
  if (extra_line > 0) storage.repairs.push_back({extra_line, "more numbers than columns; the surplus is ignored"});
  if (nan_line > 0) storage.repairs.push_back({nan_line, "a value is not a number; kept as a gap"});
  if (const auto said = count_of(storage.header, {"nRows", "datarows"}); said && *said != time.size() + repeated) {
    storage.repairs.push_back({0, fmt::format("the header says {} rows, there are {}", *said, time.size() + repeated)});
  }
  const auto count = static_cast<Eigen::Index>(time.size());
  values.conservativeResize(count, Eigen::NoChange);
  storage.data = TimeSeries(Eigen::Map<const Eigen::VectorXd>(time.data(), count), std::move(channels), std::move(values));
  return storage;
}

Storage read_storage(const std::filesystem::path& path) { return parse_storage(read_text_file(path), path); }

TimeSeries to_si(const Storage& storage, const std::function<bool(const std::string&)>& is_angle, Unit other) {
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
