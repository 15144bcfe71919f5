#include "myoid/recording/column_unit.h"

#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

void require_unit(const std::filesystem::path& path, const SeriesFile& file, Eigen::Index column, Unit expected) {
  const auto at = static_cast<std::size_t>(column);
  const Channel& channel = file.data.channels()[at];
  const bool stated = at < file.to_si.size() && file.to_si[at] != 0.0;
  if (channel.unit == expected || (channel.unit == Unit::dimensionless && !stated)) return;
  throw ReadError(
      path, 0,
      fmt::format("column '{}' is in {}, expected {}; correct the unit in the header", channel.name,
                  channel.unit == Unit::dimensionless ? "a share (1 or %)" : symbol(channel.unit), symbol(expected)));
}

void require_known_unit(const std::filesystem::path& path, const SeriesFile& file, const std::string& name) {
  if (file.data.find(name)) return;
  for (const Channel& channel : file.data.channels()) {
    if (!channel.name.starts_with(name)) continue;
    const std::string_view behind = trim(std::string_view(channel.name).substr(name.size()));
    if (behind.empty() || (behind.front() != '[' && behind.front() != '(')) continue;
    throw ReadError(path, 0,
                    fmt::format("column '{}': {} is no unit that is known; write the numbers in a unit such as N m, "
                                "N mm, deg or rad, and its name in brackets",
                                channel.name, behind));
  }
}

double written_factor(const SeriesFile& file, Eigen::Index column) {
  const auto at = static_cast<std::size_t>(column);
  return at < file.to_si.size() && file.to_si[at] != 0.0 ? file.to_si[at] : 1.0;
}

}  // namespace myoid::recording
