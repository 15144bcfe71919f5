#include "myoid/recording/tables/result_units.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "myoid/ground/files/text_file.h"

namespace myoid::recording {
namespace {

bool is_translation(const std::string& coordinate) {
  constexpr std::array<std::string_view, 3> kEnds{"_tx", "_ty", "_tz"};
  return std::ranges::any_of(kEnds, [&](std::string_view end) { return coordinate.ends_with(end); });
}

constexpr std::array<std::string_view, 7> kOtherQuantities{"force",      "torque",     "moment",    "emg",
                                                           "electromyo", "activation", "excitation"};
constexpr std::array<std::string_view, 5> kRatesAndMuscles{"speed", "velocit", "accelerat", "power", "fiber"};

template <std::size_t N>
bool has_word_of(const std::string& name, const std::array<std::string_view, N>& words) {
  const std::string text = small_letters(name);
  return std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

/// Returns true if the columns are vectors: NAMEx, NAMEy and NAMEz in turn, as in files of forces, points and torques
/// ("rfx", "r_grf_vx", "FP1_px"), and no name speaks of an angle.
bool are_vectors(const std::vector<Channel>& channels) {
  if (channels.empty() || channels.size() % 3 != 0) return false;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::string name = small_letters(channels[c].name), first = small_letters(channels[c - c % 3].name);
    if (name.size() < 2 || name.size() != first.size() || name.back() != "xyz"[c % 3] ||
        name.compare(0, name.size() - 1, first, 0, first.size() - 1) != 0 || name.find("ang") != std::string::npos)
      return false;
  }
  return true;
}

}  // namespace

bool names_other_quantity(const std::string& name) {
  return has_word_of(name, kOtherQuantities) || has_word_of(name, kRatesAndMuscles);
}

bool may_hold_angles(const Storage& file) {
  // A person's trial may be called "speed 2"; OpenSim's own tables of speeds have these titles.
  const std::string title = small_letters(file.title);
  const bool of_rates = title == "speeds" || title == "velocities" || title == "accelerations";
  return !of_rates && !has_word_of(title, kOtherQuantities) && !are_vectors(file.data.channels()) &&
         !std::ranges::all_of(file.data.channels(), [&](const Channel& c) { return names_other_quantity(c.name); });
}

bool is_angle_in_degrees(const Storage& file, const std::string& channel) {
  return file.in_degrees && may_hold_angles(file) && !is_translation(channel) && !names_other_quantity(channel);
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
