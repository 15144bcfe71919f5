#include "myoid/recording/storage_writer.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/text_file.h"

namespace myoid::recording {

std::string format_storage(const TimeSeries& series, const StorageFormat& format) {
  require_finite(series, "storage file");
  std::string text = fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\n\n",
                                 format.title, series.sample_count(), series.channel_count() + 1,
                                 format.angles_in_degrees ? "yes" : "no");
  if (format.in_si) text += "Units are S.I. units (second, meters, Newtons, ...)\n";
  if (format.angles_in_degrees) text += "Angles are in degrees.\n";
  for (const std::string& comment : format.comments) text += comment + "\n";
  text += "\nendheader\ntime";
  for (const Channel& channel : series.channels()) text += "\t" + channel.name;
  text += '\n';
  for (Eigen::Index row = 0; row < series.sample_count(); ++row) {
    text += format_number(series.time_s()[row]);
    for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
      const bool degrees = format.angles_in_degrees &&
                           series.channels()[static_cast<std::size_t>(c)].unit == Unit::radian;
      text += '\t';
      text += format_number(degrees ? series.values()(row, c) / kDegree : series.values()(row, c));
    }
    text += '\n';
  }
  return text;
}

void write_storage(const std::filesystem::path& path,
                   const TimeSeries& series,
                   const StorageFormat& format) {
  write_file(path, format_storage(series, format));
}

void write_csv(const std::filesystem::path& path,
               const TimeSeries& series,
               const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks) text += "# " + remark + "\n";
  text += "time_s";
  for (const Channel& channel : series.channels()) {
    text += "," + channel.name;
    if (channel.unit != Unit::dimensionless) text += fmt::format(" [{}]", symbol(channel.unit));
  }
  text += '\n';
  for (Eigen::Index row = 0; row < series.sample_count(); ++row) {
    text += format_number(series.time_s()[row]);
    for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
      const double value = series.values()(row, c);
      text += ',';
      if (std::isfinite(value)) text += format_number(value);
    }
    text += '\n';
  }
  write_file(path, text);
}

}  // namespace myoid::recording
