#include "myoid/tables/result_units.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace myoid::recording {
namespace {

bool is_translation(const std::string& coordinate) {
  constexpr std::array<std::string_view, 3> kEnds{"_tx", "_ty", "_tz"};
  return std::ranges::any_of(kEnds, [&](std::string_view end) { return coordinate.ends_with(end); });
}

}  // namespace

std::string result_unit(const std::string& series, const std::string& channel, bool in_degrees) {
  if (series == "ik") return is_translation(channel) ? "m" : in_degrees ? "deg" : "rad";
  if (series == "ik_marker_errors") return channel == "total_squared_error" ? "m^2" : "m";
  if (series == "id") return channel.ends_with("_moment") ? "N m" : "N";
  if (series == "MuscleAnalysis_MuscleTendonVelocity") return "m/s";
  if (series == "MuscleAnalysis_Length" || series.starts_with("MuscleAnalysis_MomentArm_")) return "m";
  if (series.starts_with("predicted_torque_")) return "N m";
  if (series == "activation" || series.ends_with("_activation")) return "1";
  if (series.ends_with("_force") || series.ends_with("_forces")) return channel.ends_with("_reserve") ? "N m" : "N";
  return {};
}

}  // namespace myoid::recording
