#include "myoid/recording/emg_channels.h"

#include "myoid/tables/instrument_names.h"

namespace myoid::recording {

std::vector<std::string> emg_channels(const std::vector<Channel>& channels, const std::vector<PlateSetup>& plates) {
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
