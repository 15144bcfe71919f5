#include "myoid/ground/core/angle_unit.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::inline ground {
namespace {

constexpr double kMoves_rad = 0.2 * kDegree;
constexpr std::ptrdiff_t kOddOneIn = 10;

}  // namespace

std::string check_angle_unit(const std::filesystem::path& path, bool says_degrees, const TimeSeries& motion) {
  double widest_rad = 0.0;
  std::vector<std::pair<double, std::string>> largest;  // of each angle [rad], the greatest first
  std::ptrdiff_t moving = 0;
  for (Eigen::Index c = 0; c < motion.channel_count(); ++c) {
    const Channel& channel = motion.channels()[static_cast<std::size_t>(c)];
    if (channel.unit != Unit::radian || motion.sample_count() == 0) continue;
    const auto column = motion.values().col(c);
    const double range_rad = column.maxCoeff() - column.minCoeff();
    largest.emplace_back(column.cwiseAbs().maxCoeff(), channel.name);
    moving += range_rad > kMoves_rad ? 1 : 0;
    widest_rad = std::max(widest_rad, range_rad);
  }
  if (largest.empty()) return {};
  std::ranges::sort(largest, std::greater());
  if (!says_degrees && largest[0].first > 4.0 * kPi) {
    throw ReadError(path, 0,
                    "column '{}' reaches {:.4g} although the header says radians: these are degrees; say so there "
                    "(inDegrees=yes, or [deg] behind the name in a table)",
                    largest[0].second, largest[0].first);
  }
  // A small joint may move little, but over a whole motion some joint exceeds 3.5 degrees. A posture that is held sways
  // by a small part of its angle; the radians of a small movement change by much of it. Of many angles one or the other
  // counts turns.
  const auto& [largest_rad, name] = largest[static_cast<std::size_t>(moving / kOddOneIn)];
  const bool moves = widest_rad > kMoves_rad || (widest_rad > 0.02 * kDegree && widest_rad > 0.3 * largest_rad);
  if (!says_degrees || largest_rad >= 3.5 * kDegree || !moves) return {};
  return fmt::format(
      "{} 3.5 degrees (the largest is '{}') although the header says degrees; if these are radians, say so there "
      "(inDegrees=no, or [rad] behind the name in a table)",
      moving < kOddOneIn ? "no angle reaches" : "hardly an angle reaches", name);
}

}  // namespace myoid::inline ground
