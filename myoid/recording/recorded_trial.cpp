#include "myoid/recording/recorded_trial.h"

namespace myoid::recording {

std::vector<const AnalogChannels*> Recording::clocks() const {
  std::vector<const AnalogChannels*> list{&analog};
  for (const AnalogChannels& other : other_clocks) list.push_back(&other);
  return list;
}

ForcePlate Recording::force_plate(const PlateSetup& plate) const {
  return recording::force_plate(plate, analog.time_s(), analog.as_written(plate.channels));
}

std::vector<ForcePlate> Recording::force_plates() const {
  std::vector<ForcePlate> list;
  for (const PlateSetup& plate : plates) list.push_back(force_plate(plate));
  return list;
}

}  // namespace myoid::recording
