#include "myoid/recording/emg_channels.h"

#include <algorithm>
#include <array>
#include <regex>

#include "myoid/recording/label_match.h"

namespace myoid::recording {

bool named_as_no_emg(std::string_view name) {
  // Letters and digits alone: instrument, then quantity, axis and number in either order.
  static const std::regex kForce(
      "(force|moment|torque|grf|amti|bertec|kistler|forceplate|plate|fp|[0-9])*"
      "(f|m|cop|p)[0-9]*[xyz][0-9]*");
  static constexpr std::array<std::string_view, 8> kInstruments{
      "sync", "trig", "footsw", "heelsw", "gonio", "accel", "gyro", "loadcell"};
  const std::string plain = plain_label(name);
  return std::regex_match(plain, kForce) ||
         std::any_of(kInstruments.begin(), kInstruments.end(),
                     [&](std::string_view word) { return plain.starts_with(word); });
}

std::vector<std::string> emg_channels(const std::vector<Channel>& channels,
                                      const std::vector<PlateSetup>& plates) {
  std::vector<bool> of_plate(channels.size(), false);
  for (const PlateSetup& plate : plates) {
    for (const Eigen::Index column : plate.channels) {
      if (column >= 0 && static_cast<std::size_t>(column) < of_plate.size())
        of_plate[static_cast<std::size_t>(column)] = true;
    }
  }
  std::vector<std::string> names;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c].unit == Unit::volt && !of_plate[c] && !named_as_no_emg(channels[c].name))
      names.push_back(channels[c].name);
  }
  return names;
}

}  // namespace myoid::recording
