#pragma once

#include <optional>
#include <vector>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/files/analog_channels.h"
#include "myoid/ground/files/event.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// One trial as measured, from a single file: in SI, on the file's clock, in the laboratory's
/// frame. Parts that the file lacks are empty.
struct Recording {
  MarkerSeries markers;
  AnalogChannels analog;  ///< EMG and all other channels; a channel of unknown unit is dimensionless.
  std::vector<AnalogChannels> other_clocks;  ///< Channels with clocks of their own.
  std::vector<PlateSetup> plates;
  std::optional<Vec3> screen_up_L;  ///< POINT:Y_SCREEN of a .c3d file; `laboratory_up` says which way is up.
  std::vector<Event> events;
  std::vector<Repair> repairs;

  /// Returns `analog` and each of `other_clocks`.
  [[nodiscard]] std::vector<const AnalogChannels*> clocks() const;

  /// Returns a plate over time. It takes 13 doubles a sample: process the plates of a large file one by one.
  [[nodiscard]] ForcePlate force_plate(const PlateSetup& plate) const;
  [[nodiscard]] std::vector<ForcePlate> force_plates() const;
};

}  // namespace myoid::recording
