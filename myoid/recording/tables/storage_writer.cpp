#include "myoid/recording/tables/storage_writer.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/quoted_text.h"

namespace myoid::recording {
namespace {

std::string storage_header(const RowSource& source, const StorageFormat& format) {
  std::string text = fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\n\n", format.title, source.rows,
                                 source.channels.size() + 1, format.angles_in_degrees ? "yes" : "no");
  if (format.in_si) text += "Units are S.I. units (second, meters, Newtons, ...)\n";
  if (format.angles_in_degrees) text += "Angles are in degrees.\n";
  for (const std::string& comment : format.comments) text += comment + "\n";
  text += "\nendheader\ntime";
  for (const Channel& channel : source.channels) text += "\t" + channel.name;
  return text + "\n";
}

/// Writes the rows of a source as lines; `cell` writes one value.
template <typename Cell>
void put_lines(const RowSource& source, char separator, const Cell& cell, const TextSink& sink) {
  const auto columns = static_cast<Eigen::Index>(source.channels.size());
  const RowText text = [&](Eigen::Index first, Eigen::Index count, NumberText& numbers, char* at) {
    Eigen::VectorXd time_s;
    Eigen::MatrixXd values;
    source.read(first, count, time_s, values);
    for (Eigen::Index row = 0; row < count; ++row) {
      for (Eigen::Index c = 0; c < columns && row + 1 < count; ++c) numbers.announce(values(row + 1, c));
      at = put_number(at, time_s[row]);
      for (Eigen::Index c = 0; c < columns; ++c) {
        *at++ = separator;
        at = cell(numbers, at, time_s[row], c, values(row, c));
      }
      *at++ = '\n';
    }
    return at;
  };
  write_rows(source.rows, columns + 1, text, sink);
}

void put_storage(const RowSource& source, const StorageFormat& format, const TextSink& sink) {
  std::vector<double> over;
  for (const Channel& channel : source.channels)
    over.push_back(format.angles_in_degrees && channel.unit == Unit::radian ? kDegree : 1.0);
  sink(storage_header(source, format));
  const auto cell = [&](NumberText& numbers, char* at, double time_s, Eigen::Index c, double value) {
    const auto column = static_cast<std::size_t>(c);
    if (!std::isfinite(value)) {
      throw InvalidInput(fmt::format("storage file: channel '{}' is not a number at {} s; fill the gaps first",
                                     source.channels[column].name, time_s));
    }
    return numbers.put(at, value / over[column]);
  };
  put_lines(source, '\t', cell, sink);
}

}  // namespace

std::string format_storage(const TimeSeries& series, const StorageFormat& format) {
  std::string text;
  put_storage(rows_of(series), format, [&](std::string_view part) { text += part; });
  return text;
}

void write_storage(const std::filesystem::path& path, const TimeSeries& series, const StorageFormat& format) {
  require_finite(series, "storage file");
  write_storage(path, rows_of(series), format);
}

void write_csv(const std::filesystem::path& path, const TimeSeries& series, const std::vector<std::string>& remarks) {
  write_csv(path, rows_of(series), remarks);
}

void write_storage(const std::filesystem::path& path, const RowSource& source, const StorageFormat& format) {
  FileInParts file(path);
  put_storage(source, format, [&](std::string_view part) { file.append(part); });
  file.finish();
}

void write_csv(const std::filesystem::path& path, const RowSource& source, const std::vector<std::string>& remarks) {
  std::string head;
  for (const std::string& remark : remarks) head += "# " + remark + "\n";
  head += "time_s";
  for (const Channel& channel : source.channels) {
    const std::string unit = channel.unit == Unit::dimensionless ? "" : fmt::format(" [{}]", symbol(channel.unit));
    head += "," + csv_cell(channel.name + unit);
  }
  FileInParts file(path);
  file.append(head + "\n");
  const auto cell = [](NumberText& numbers, char* at, double, Eigen::Index, double value) {
    return std::isfinite(value) ? numbers.put(at, value) : at;
  };
  put_lines(source, ',', cell, [&](std::string_view part) { file.append(part); });
  file.finish();
}

}  // namespace myoid::recording
