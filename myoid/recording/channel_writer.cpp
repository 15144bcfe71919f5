#include "myoid/recording/channel_writer.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/storage_writer.h"
#include "myoid/recording/text_file.h"

namespace myoid::recording {
namespace {

constexpr std::string_view kInDegrees = "inDegrees=yes";

}  // namespace

ChannelStatement statement_of(const Storage& file) {
  ChannelStatement said{file.title, file.in_degrees, {}};
  const auto volt = stated_voltage(file);
  for (const Channel& c : file.data.channels()) {
    const auto named = file.units.find(c.name);
    said.units.push_back(named != file.units.end() ? named->second
                         : volt                    ? voltage_name(*volt)
                                                   : "");
  }
  return said;
}

ChannelStatement statement_of(const TimeSeries& series, const std::filesystem::path& file) {
  ChannelStatement said;
  if (extension_of(file) == ".csv") {
    const std::string text = read_text_file(file);
    for (std::string_view line : split_lines(text)) {
      line = trim(line);
      if (!line.empty() && !line.starts_with('#')) break;
      said.in_degrees = said.in_degrees || line.ends_with(kInDegrees);
    }
  }
  for (const Channel& c : series.channels())
    said.units.emplace_back(c.unit == Unit::dimensionless ? std::string_view() : symbol(c.unit));
  return said;
}

void write_channels(const std::filesystem::path& out,
                    const TimeSeries& series,
                    const ChannelStatement& said) {
  std::vector<Channel> named = series.channels();
  if (extension_of(out) == ".csv") {
    for (std::size_t c = 0; c < named.size(); ++c) {
      if (!said.units[c].empty()) named[c].name += " [" + said.units[c] + "]";
      named[c].unit = Unit::dimensionless;
    }
    std::vector<std::string> remarks;
    if (said.in_degrees) remarks.emplace_back(kInDegrees);
    write_csv(out, TimeSeries(series.time_s(), std::move(named), series.values()), remarks);
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
  if (volt && volt->unit == Unit::volt &&
      std::none_of(said.units.begin(), said.units.end(), other)) {
    format.comments.push_back("unit=" + said.units.front());
  } else {
    for (std::size_t c = 0; c < named.size(); ++c) {
      if (!said.units[c].empty())
        format.comments.push_back(fmt::format("channel {} [{}]", named[c].name, said.units[c]));
    }
  }
  // Column labels are separated by tabs: none inside a name.
  for (Channel& c : named) {
    std::replace(c.name.begin(), c.name.end(), '\t', ' ');
    c.unit = Unit::dimensionless;
  }
  write_storage(out, TimeSeries(series.time_s(), std::move(named), series.values()), format);
}

}  // namespace myoid::recording
