#include "myoid/recording/anc_reader.h"

#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/c3d_file.h"

namespace myoid::recording {
namespace {

/// The number behind a key somewhere in the header: "BitDepth:<tab>12".
std::optional<double> header_number(const std::vector<std::string_view>& lines,
                                    std::size_t count,
                                    std::string_view key) {
  for (std::size_t n = 0; n < count; ++n) {
    const auto cells = split(lines[n], '\t');
    for (std::size_t c = 0; c + 1 < cells.size(); ++c) {
      if (equal_ignoring_case(trim(cells[c]), key)) return parse_number(cells[c + 1]);
    }
  }
  return std::nullopt;
}

/// Cells of a row without its first one and without empty ones at its end.
std::vector<std::string_view> values_of(std::string_view line) {
  auto cells = split(line, '\t');
  while (!cells.empty() && trim(cells.back()).empty()) cells.pop_back();
  if (!cells.empty()) cells.erase(cells.begin());
  return cells;
}

}  // namespace

AncFile parse_anc(std::string_view text, const std::filesystem::path& path) {
  const auto lines = split_lines(text);
  std::size_t names_at = 0;
  const auto begins_with = [&](std::size_t n, std::string_view word) {
    return equal_ignoring_case(trim(split(lines[n], '\t')[0]), word);
  };
  while (names_at < lines.size() && !begins_with(names_at, "Name")) ++names_at;
  if (names_at + 2 >= lines.size() || !begins_with(names_at + 1, "Rate") ||
      !begins_with(names_at + 2, "Range")) {
    throw ReadError(path, 0,
                    "expected the rows Name, Rate and Range behind each other; this is no .anc "
                    "file, or it is cut off");
  }
  const auto bits = header_number(lines, names_at, "BitDepth:");
  if (!bits || !(*bits >= 1.0 && *bits <= 64.0)) {
    throw ReadError(path, 0,
                    "the header has no BitDepth: the counts cannot be scaled; export the file "
                    "again or use its C3D file");
  }
  AncFile file;
  std::vector<Channel> channels;
  std::set<std::string> seen;
  for (const std::string_view cell : values_of(lines[names_at])) {
    const std::string base =
        to_utf8(cell).empty() ? fmt::format("channel_{}", channels.size() + 1) : to_utf8(cell);
    std::string name = base;
    for (int k = 2; !seen.insert(name).second; ++k) {
      const std::string other = fmt::format("{}_{}", base, k);
      file.repairs.push_back(
          {names_at + 1,
           fmt::format("two channels are named '{}'; the later one is '{}' here", base, other)});
      name = other;
    }
    channels.push_back({name, Unit::volt});
  }
  const std::size_t width = channels.size();
  if (width == 0) throw ReadError(path, names_at + 1, "there are no channel names");
  if (const auto said = header_number(lines, names_at, "#Channels:");
      said && *said != static_cast<double>(width)) {
    file.repairs.push_back(
        {0, fmt::format("the header says {} channels, there are {} names", *said, width)});
  }
  std::vector<double> to_volt;
  const auto ranges = values_of(lines[names_at + 2]);
  for (std::size_t c = 0; c < width; ++c) {
    const auto range = c < ranges.size() ? parse_number(ranges[c]) : std::nullopt;
    if (!range || !(*range > 0.0))
      throw ReadError(path, names_at + 3,
                      fmt::format("channel '{}' has no range in mV, so its counts cannot be scaled",
                                  channels[c].name));
    to_volt.push_back(2e-3 * *range / (std::exp2(*bits) - 1.0));
  }
  std::vector<double> time;
  const std::size_t first = names_at + 3;
  Eigen::MatrixXd values(static_cast<Eigen::Index>(lines.size() - first),
                         static_cast<Eigen::Index>(width));
  for (std::size_t n = first; n < lines.size(); ++n) {
    if (trim(lines[n]).empty()) continue;
    const auto cells = values_of(lines[n]);
    if (n + 1 == lines.size() && !ends_with_line(text) && !time.empty()) {
      file.repairs.push_back({n + 1, std::string(kLastRowLeftOut)});
      break;
    }
    if (cells.size() < width && n + 1 == lines.size()) {
      file.repairs.push_back({n + 1, fmt::format("the last row has {} of {} values and is left out",
                                                 cells.size(), width)});
      break;
    }
    const auto now = parse_number(split(lines[n], '\t')[0]);
    if (!now || !std::isfinite(*now))
      throw ReadError(
          path, n + 1,
          fmt::format("expected the time as a number, found '{}'", trim(split(lines[n], '\t')[0])));
    if (!time.empty() && *now <= time.back())
      throw ReadError(path, n + 1,
                      fmt::format("time does not increase: {} s after {} s", *now, time.back()));
    if (cells.size() != width)
      throw ReadError(path, n + 1,
                      fmt::format("expected {} values, found {}", width, cells.size()));
    const auto row = static_cast<Eigen::Index>(time.size());
    for (std::size_t c = 0; c < width; ++c) {
      const auto count = parse_number(cells[c]);
      if (!count)
        throw ReadError(path, n + 1,
                        fmt::format("channel '{}': expected a number, found '{}'", channels[c].name,
                                    trim(cells[c])));
      values(row, static_cast<Eigen::Index>(c)) = to_volt[c] * *count;
    }
    time.push_back(*now);
  }
  if (time.size() < 2) throw ReadError(path, 0, "there are fewer than two rows of numbers");
  const auto count = static_cast<Eigen::Index>(time.size());
  const double rate = static_cast<double>(count - 1) / (time.back() - time.front());
  if (const auto said = header_number(lines, names_at, "PreciseRate:");
      said && std::abs(*said - rate) > 1e-3 * rate) {
    file.repairs.push_back(
        {0, fmt::format("the header says {} Hz, the times {:.6g} Hz; the times are taken", *said,
                        rate)});
  }
  if (const auto said = header_number(lines, names_at, "Duration(Sec.):");
      said && std::abs(*said - static_cast<double>(count) / rate) > 2.0 / rate) {
    file.repairs.push_back(
        {0, fmt::format("the header says {} s, the rows cover {:.6g} s: the file may be cut off",
                        *said, static_cast<double>(count) / rate)});
  }
  values.conservativeResize(count, Eigen::NoChange);
  file.repairs.push_back(
      {0, "volts at the board's input: the amplifier's gain is not in the file"});
  file.data = TimeSeries(Eigen::Map<const Eigen::VectorXd>(time.data(), count), std::move(channels),
                         std::move(values));
  return file;
}

AncFile read_anc(const std::filesystem::path& path) {
  return parse_anc(read_text_file(path), path);
}

}  // namespace myoid::recording
