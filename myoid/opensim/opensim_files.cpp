#include "myoid/opensim/opensim_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/angle_unit.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::opensim {
namespace {

/// Returns the coordinate that a column of a motion or states file holds, or -1.
int coordinate_of(const body::BodyModel& model, const std::string& column) {
  constexpr std::string_view kValue = "/value";
  std::string_view path = column;
  if (path.ends_with(kValue)) {
    path.remove_suffix(kValue.size());
  } else if (path.find('/') != std::string_view::npos && !path.starts_with("/jointset/")) {
    return -1;  // another state
  }
  return model.find_coordinate(path).value_or(-1);
}

}  // namespace

TimeSeries read_coordinates(const body::BodyModel& model,
                            const std::filesystem::path& path,
                            MissingCoordinate missing,
                            std::vector<Remark>& remarks) {
  const recording::Storage file = recording::read_storage(path);
  for (const Repair& repair : file.repairs)
    remarks.push_back({.code = RemarkCode::reading, .says = recording::to_string(path, repair)});
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd q(file.data.sample_count(), count);
  std::vector<Channel> channels;
  std::vector<bool> found(model.coordinates.size(), false), is_given = found;
  for (Eigen::Index k = 0; k < count; ++k) {
    const body::Coordinate& c = model.coordinates[at(k)];
    channels.push_back({c.name, body::coordinate_unit(c, 0)});
    if (missing == MissingCoordinate::zero && body::is_held(c)) {
      q.col(k) = body::held_values(c, file.data.time_s());
      is_given[at(k)] = true;
    } else {
      q.col(k).setConstant(missing == MissingCoordinate::zero ? 0.0 : c.default_value);
    }
  }
  bool any = false;
  for (std::size_t column = 0; column < file.data.channels().size(); ++column) {
    const int k = coordinate_of(model, file.data.channels()[column].name);
    if (k < 0 || found[at(k)]) continue;
    const bool angle = model.coordinates[at(k)].motion == body::MotionType::rotational;
    q.col(k) = file.data.values().col(static_cast<Eigen::Index>(column)) * (angle && file.in_degrees ? kDegree : 1.0);
    found[at(k)] = true;
    any = true;
  }
  if (!any) {
    throw InvalidInput(fmt::format("{}: no column ({}) is a coordinate of the model '{}'", path.string(),
                                   channel_names(file.data), model.name));
  }
  std::string absent;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k] && !is_given[k]) absent += (absent.empty() ? "" : ", ") + model.coordinates[k].name;
  }
  if (!absent.empty()) {
    remarks.push_back({.says = fmt::format("{}: no column for {}; they stay at {}", path.string(), absent,
                                           missing == MissingCoordinate::zero ? "0, as in OpenSim's analyses"
                                                                              : "their default values")});
  }
  TimeSeries result(file.data.time_s(), std::move(channels), std::move(q));
  require_finite(result, path.string());
  if (const std::string doubt = check_angle_unit(path, file.in_degrees, result); !doubt.empty())
    remarks.push_back({.says = fmt::format("{}: {}", path.filename().string(), doubt)});
  return result;
}

Eigen::Index row_at(const Eigen::VectorXd& times_s, double time_s) {
  const double* end = std::upper_bound(times_s.data(), times_s.data() + times_s.size(), time_s);
  return std::max<Eigen::Index>(0, end - times_s.data() - 1);
}

TimeSeries ColumnTable::at_times(const Eigen::VectorXd& times_s) const {
  Eigen::MatrixXd values(times_s.size(), static_cast<Eigen::Index>(columns_.size()));
  for (Eigen::Index c = 0; c < values.cols(); ++c) values.col(c) = columns_[at(c)];
  return {times_s, channels_, std::move(values)};
}

TimeSeries with_file_units(const body::BodyModel& model, const TimeSeries& q) {
  std::vector<Channel> channels = q.channels();
  for (Channel& channel : channels) {
    const auto c = model.find_coordinate(channel.name);
    if (c && model.coordinates[at(*c)].motion == body::MotionType::coupled) channel.unit = Unit::dimensionless;
  }
  return {q.time_s(), std::move(channels), q.values()};
}

void write_opensim_storage(const std::filesystem::path& path, const TimeSeries& series, const OpensimFormat& format) {
  std::string text = fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\n{}endheader\ntime", format.title,
                                 series.sample_count(), series.channel_count() + 1, format.in_degrees ? "yes" : "no",
                                 format.description);
  for (const Channel& channel : series.channels()) text += "\t" + channel.name;
  text += '\n';
  const auto width = static_cast<std::size_t>(format.decimals + 8);
  // Room for every number and, behind the last, for the longest.
  std::size_t room = text.size() +
                     static_cast<std::size_t>(series.values().size() + series.sample_count()) * (width + 1) +
                     kFixedRoom + 1;
  auto buffer = std::make_unique_for_overwrite<char[]>(room);
  std::size_t used = text.copy(buffer.get(), text.size());
  // Most moment arms of a body are zero; the copy is of one size, the place has room.
  constexpr std::size_t kZeroRoom = 64;
  static_assert(kFixedRoom >= kZeroRoom);
  std::array<char, kFixedRoom> zero{};
  const auto zero_size = static_cast<std::size_t>(write_fixed(zero.data(), 0.0, format.decimals, width) - zero.data());
  const auto write = [&](double value, char behind) {
    if (room - used <= kFixedRoom) {
      auto larger = std::make_unique_for_overwrite<char[]>(2 * room);
      std::memcpy(larger.get(), buffer.get(), used);
      buffer = std::move(larger);
      room *= 2;
    }
    char* end = buffer.get() + used;
    if (value == 0.0 && !std::signbit(value)) {
      std::memcpy(end, zero.data(), kZeroRoom);
      end += zero_size;
    } else {
      end = write_fixed(end, value, format.decimals, width);
    }
    *end = behind;
    used = static_cast<std::size_t>(end - buffer.get()) + 1;
  };
  std::vector<double> factor;
  for (const Channel& channel : series.channels())
    factor.push_back(format.in_degrees && channel.unit == Unit::radian ? kDegree : 1.0);
  const Eigen::Index columns = series.channel_count();
  for (Eigen::Index row = 0; row < series.sample_count(); ++row) {
    write(series.time_s()[row], columns > 0 ? '\t' : '\n');
    for (Eigen::Index c = 0; c < columns; ++c) {
      write(series.values()(row, c) / factor[at(c)], c + 1 < columns ? '\t' : '\n');
    }
  }
  write_file(path, {buffer.get(), used}, Flush::later);
}

}  // namespace myoid::opensim
