#include "myoid/recording/channel_writer.h"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_writer.h"

namespace myoid::recording {
namespace {

constexpr std::string_view kInDegrees = "inDegrees=yes";

/// Returns true if a remark above a table says that angles are in degrees; the table itself is not read.
bool remarks_degrees(const std::filesystem::path& file) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    const std::string_view text = trim(line);
    if (!text.empty() && !text.starts_with('#')) return false;
    if (text.ends_with(kInDegrees)) return true;
  }
  return false;
}

}  // namespace

ChannelStatement statement_of(const Storage& file) {
  ChannelStatement said{file.title, file.in_degrees, {}};
  const auto volt = stated_voltage(file);
  for (const Channel& c : file.data.channels()) {
    const auto named = file.units.find(c.name);
    said.units.push_back(named != file.units.end() ? named->second : volt ? voltage_name(*volt) : "");
  }
  return said;
}

ChannelStatement statement_of(const std::vector<Channel>& channels, const std::filesystem::path& file) {
  ChannelStatement said;
  if (extension_of(file) == ".csv") said.in_degrees = remarks_degrees(file);
  for (const Channel& c : channels)
    said.units.emplace_back(c.unit == Unit::dimensionless ? std::string_view() : symbol(c.unit));
  return said;
}

void write_channels(const std::filesystem::path& out, RowSource rows, const ChannelStatement& said) {
  std::vector<Channel>& named = rows.channels;
  if (extension_of(out) == ".csv") {
    for (std::size_t c = 0; c < named.size(); ++c) {
      if (!said.units[c].empty()) named[c].name += " [" + said.units[c] + "]";
      named[c].unit = Unit::dimensionless;
    }
    std::vector<std::string> remarks;
    if (said.in_degrees) remarks.emplace_back(kInDegrees);
    write_csv(out, rows, remarks);
    return;
  }
  StorageFormat format;
  format.title = said.title.empty() ? out.stem().string() : said.title;
  format.angles_in_degrees = said.in_degrees;
  const auto is_si = [](const std::string& unit) {
    const auto known = parse_unit(unit);
    return known && known->to_si == 1.0;
  };
  format.in_si = std::all_of(said.units.begin(), said.units.end(), is_si);
  const auto other = [&](const std::string& unit) { return unit != said.units.front(); };
  const auto volt = said.units.empty() ? std::nullopt : parse_unit(said.units.front());
  if (volt && volt->unit == Unit::volt && std::none_of(said.units.begin(), said.units.end(), other)) {
    format.comments.push_back("unit=" + said.units.front());
  } else {
    for (std::size_t c = 0; c < named.size(); ++c) {
      if (!said.units[c].empty())
        format.comments.push_back(fmt::format("channel {} [{}]", named[c].name, said.units[c]));
    }
  }
  // Tabs separate column labels: none may be inside a name.
  for (Channel& c : named) {
    std::replace(c.name.begin(), c.name.end(), '\t', ' ');
    c.unit = Unit::dimensionless;
  }
  write_storage(out, rows, format);
}

}  // namespace myoid::recording
