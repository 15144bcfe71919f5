#include "myoid/recording/anc_reader.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/tables/table_clock.h"

namespace myoid::recording {
namespace {

/// Returns the number behind a key anywhere in the header: "BitDepth:<tab>12".
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

/// Returns the cells of a row without the first one and without empty ones at its end.
std::vector<std::string_view> values_of(std::string_view line) {
  auto cells = split(line, '\t');
  while (!cells.empty() && trim(cells.back()).empty()) cells.pop_back();
  if (!cells.empty()) cells.erase(cells.begin());
  return cells;
}

/// Returns the layout of the rows below Name, Rate and Range: a time and one count a channel.
TableLayout anc_layout(const TableText& table, std::size_t names_line, const std::vector<Channel>& channels) {
  TableLayout layout;
  layout.separator = '\t';
  layout.names_line = names_line;
  layout.first_row = names_line + 3;
  layout.end_row = table.lines.size();
  layout.columns = {{TableColumn::Kind::time, "time"}};
  for (const Channel& channel : channels) layout.columns.push_back({TableColumn::Kind::channel, channel.name});
  return layout;
}

/// Returns the index of the row of names, above the rows Rate and Range.
std::size_t find_names(const std::vector<std::string_view>& lines, const std::filesystem::path& path) {
  const auto begins_with = [&](std::size_t n, std::string_view word) {
    return equal_ignoring_case(trim(split(lines[n], '\t')[0]), word);
  };
  std::size_t at = 0;
  while (at < lines.size() && !begins_with(at, "Name")) ++at;
  if (at + 2 >= lines.size() || !begins_with(at + 1, "Rate") || !begins_with(at + 2, "Range")) {
    throw ReadError(path, 0,
                    "expected the rows Name, Rate and Range behind each other; this is no .anc file, or it is cut off");
  }
  return at;
}

std::vector<Channel> read_channels(const std::vector<std::string_view>& lines,
                                   std::size_t names_at,
                                   const std::filesystem::path& path,
                                   std::vector<Repair>& repairs) {
  std::vector<std::string> names;
  for (const std::string_view cell : values_of(lines[names_at])) {
    const std::string name = to_utf8(cell);
    names.push_back(name.empty() ? fmt::format("channel_{}", names.size() + 1) : name);
  }
  if (names.empty()) throw ReadError(path, names_at + 1, "there are no channel names");
  std::vector<Channel> channels;
  for (const std::string& name : unique_names(names, "channel", names_at + 1, repairs))
    channels.push_back({name, Unit::volt});
  if (const auto said = header_number(lines, names_at, "#Channels:");
      said && *said != static_cast<double>(channels.size())) {
    note(repairs, "the header says {} channels, there are {} names", *said, channels.size());
  }
  return channels;
}

/// Returns the volts per count of each channel: 2 range / (2^bits - 1), with the range in mV to either side of 0.
std::vector<double> volts_per_count(const std::vector<std::string_view>& lines,
                                    std::size_t names_at,
                                    double bits,
                                    const std::vector<Channel>& channels,
                                    const std::filesystem::path& path) {
  std::vector<double> to_volt;
  const auto ranges = values_of(lines[names_at + 2]);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto range = c < ranges.size() ? parse_number(ranges[c]) : std::nullopt;
    if (!range || !(*range > 0.0))
      throw ReadError(path, names_at + 3, "channel '{}' has no range in mV, so its counts cannot be scaled",
                      channels[c].name);
    to_volt.push_back(2e-3 * *range / (std::exp2(bits) - 1.0));
  }
  return to_volt;
}

/// Notes where the header's rate or length differs from that of the rows.
void compare_clock(const std::vector<std::string_view>& lines,
                   std::size_t names_at,
                   const Eigen::VectorXd& time_s,
                   std::vector<Repair>& repairs) {
  const Eigen::Index count = time_s.size();
  const double rate = static_cast<double>(count - 1) / (time_s[count - 1] - time_s[0]);
  if (const auto said = header_number(lines, names_at, "PreciseRate:"); said && std::abs(*said - rate) > 1e-3 * rate) {
    repairs.push_back(other_rate(0, *said, rate, static_cast<double>(count - 1)));
  }
  if (const auto said = header_number(lines, names_at, "Duration(Sec.):");
      said && std::abs(*said - static_cast<double>(count) / rate) > 2.0 / rate) {
    note(repairs, "the header says {} s, the rows cover {:.6g} s: the file may be cut off", *said,
         static_cast<double>(count) / rate);
    repairs.back().lost = *said > static_cast<double>(count) / rate;
    std::rotate(repairs.begin(), repairs.end() - 1, repairs.end());  // before the last row
  }
}

}  // namespace

AncFile parse_anc(std::string_view text, const std::filesystem::path& path) {
  const TableText table(text);
  const auto& lines = table.lines;
  const std::size_t names_at = find_names(lines, path);
  const auto bits = header_number(lines, names_at, "BitDepth:");
  if (!bits || !(*bits >= 1.0 && *bits <= 64.0)) {
    throw ReadError(
        path, 0, "the header has no BitDepth: the counts cannot be scaled; export the file again or use its C3D file");
  }
  AncFile file;
  std::vector<Channel> channels = read_channels(lines, names_at, path, file.repairs);
  const std::vector<double> to_volt = volts_per_count(lines, names_at, *bits, channels, path);
  const TableLayout layout = anc_layout(table, names_at, channels);
  TableNumbers numbers = read_rows(table, rows_of(layout), path);
  file.repairs.insert(file.repairs.end(), numbers.repairs.begin(), numbers.repairs.end());
  const Eigen::VectorXd time = row_times(layout, numbers, path, file.repairs);
  if (time.size() < 2) throw ReadError(path, 0, "there are fewer than two rows of numbers");
  for (std::size_t c = 0; c < channels.size(); ++c) numbers.values.col(static_cast<Eigen::Index>(c)) *= to_volt[c];
  compare_clock(lines, names_at, time, file.repairs);
  note(file.repairs, "volts at the board's input: the amplifier's gain is not in the file");
  file.data = TimeSeries(time, std::move(channels), std::move(numbers.values));
  return file;
}

AncFile read_anc(const std::filesystem::path& path) { return parse_anc(read_text_file(path), path); }

}  // namespace myoid::recording
