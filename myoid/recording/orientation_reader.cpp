#include "myoid/recording/orientation_reader.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::recording {
namespace {

bool holds_quaternions(const Storage& file) {
  return std::ranges::any_of(file.header, [](const auto& entry) {
    return equal_ignoring_case(entry.first, "DataType") && equal_ignoring_case(entry.second, "Quaternion");
  });
}

/// Returns the sensors of the columns NAME_1 to NAME_4.
std::vector<std::string> sensors_of(const std::vector<Channel>& channels) {
  constexpr std::size_t kEnding = 2;
  std::vector<std::string> names;
  for (std::size_t c = 0; c < channels.size(); c += 4)
    names.push_back(channels[c].name.substr(0, channels[c].name.size() - kEnding));
  return names;
}

}  // namespace

Mat3 OrientationSeries::rotation(Eigen::Index frame, std::size_t sensor) const {
  const auto q = quaternions.block<1, 4>(frame, 4 * static_cast<Eigen::Index>(sensor));
  if (!q.allFinite()) return Mat3::Constant(kNan);
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

OrientationSeries read_orientations(const std::filesystem::path& path) {
  Storage file = read_storage(path);
  if (!holds_quaternions(file) || file.data.channel_count() == 0) {
    throw ReadError(
        path, 1,
        "expected a storage file of orientations: a header with 'DataType=Quaternion', then a column for each sensor");
  }
  OrientationSeries series{file.data.time_s(), sensors_of(file.data.channels()), file.data.values(),
                           std::move(file.repairs)};
  for (Eigen::Index i = 0; i < series.quaternions.rows(); ++i) {
    for (Eigen::Index c = 0; c < series.quaternions.cols(); c += 4) {
      auto q = series.quaternions.block<1, 4>(i, c);
      if (!q.allFinite()) {
        q.setConstant(kNan);
      } else if (q.norm() > 0.0) {
        q.normalize();
      } else {
        throw ReadError(
            path, 0,
            fmt::format("sensor '{}' at {} s: a quaternion of length 0", series.names[at(c / 4)], series.time_s[i]));
      }
    }
  }
  return series;
}

}  // namespace myoid::recording
