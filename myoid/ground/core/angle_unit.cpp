#include "myoid/ground/core/angle_unit.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::inline ground {

std::string check_angle_unit(const std::filesystem::path& path, bool says_degrees, const TimeSeries& motion) {
  double largest_rad = 0.0, widest_rad = 0.0;
  std::string largest_name;
  for (Eigen::Index c = 0; c < motion.channel_count(); ++c) {
    const Channel& channel = motion.channels()[static_cast<std::size_t>(c)];
    if (channel.unit != Unit::radian || motion.sample_count() == 0) continue;
    const auto column = motion.values().col(c);
    const double largest = column.cwiseAbs().maxCoeff();
    if (largest > largest_rad) {
      largest_rad = largest;
      largest_name = channel.name;
    }
    widest_rad = std::max(widest_rad, column.maxCoeff() - column.minCoeff());
  }
  if (!says_degrees && largest_rad > 4.0 * kPi) {
    throw ReadError(path, 0,
                    "column '{}' reaches {:.4g} although the header says radians: these are degrees; say so there "
                    "(inDegrees=yes, or [deg] behind the name in a table)",
                    largest_name, largest_rad);
  }
  // A small joint may move little, but over a whole motion some joint exceeds 3.5 degrees. A posture that is held sways
  // by a small part of its angle; the radians of a small movement change by much of it.
  const bool moves = widest_rad > 0.2 * kDegree || (widest_rad > 0.02 * kDegree && widest_rad > 0.3 * largest_rad);
  if (says_degrees && largest_rad < 3.5 * kDegree && moves) {
    return fmt::format(
        "no angle reaches 3.5 degrees (the largest is '{}') although the header says degrees; if these are radians, "
        "say "
        "so there (inDegrees=no, or [rad] behind the name in a table)",
        largest_name);
  }
  return {};
}

}  // namespace myoid::inline ground
