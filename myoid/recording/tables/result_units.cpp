#include "myoid/recording/tables/result_units.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "myoid/ground/files/text_file.h"

namespace myoid::recording {
namespace {

bool is_translation(const std::string& coordinate) {
  constexpr std::array<std::string_view, 3> kEnds{"_tx", "_ty", "_tz"};
  return std::ranges::any_of(kEnds, [&](std::string_view end) { return coordinate.ends_with(end); });
}

bool speaks_of_other(const std::string& name) {
  const std::string text = small_letters(name);
  constexpr std::string_view kOthers[] = {"force", "torque", "moment", "emg", "electromyo", "activation", "excitation"};
  return std::ranges::any_of(kOthers, [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

}  // namespace

bool may_hold_angles(const Storage& file) {
  return !speaks_of_other(file.title) &&
         !std::ranges::all_of(file.data.channels(), [&](const Channel& c) { return speaks_of_other(c.name); });
}

bool is_angle_in_degrees(const Storage& file, const std::string& channel) {
  return file.in_degrees && may_hold_angles(file) && !is_translation(channel) && !speaks_of_other(channel);
}

std::string result_unit(const std::string& series, const std::string& channel, bool in_degrees) {
  if (series == "ik") return is_translation(channel) ? "m" : in_degrees ? "deg" : "rad";
  if (series == "ik_marker_errors") return channel == "total_squared_error" ? "m^2" : "m";
  if (series == "id") return channel.ends_with("_moment") ? "N m" : "N";
  if (series == "MuscleAnalysis_MuscleTendonVelocity") return "m/s";
  if (series == "MuscleAnalysis_Length" || series.starts_with("MuscleAnalysis_MomentArm_")) return "m";
  if (series.starts_with("predicted_torque_")) return "N m";
  if (series == "activation" || series == "drive" || series.ends_with("_activation")) return "1";
  if (series.ends_with("_force") || series.ends_with("_forces")) return channel.ends_with("_reserve") ? "N m" : "N";
  return {};
}

}  // namespace myoid::recording
