#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/files/analog_channels.h"
#include "myoid/files/event.h"
#include "myoid/files/marker_series.h"
#include "myoid/files/text_file.h"
#include "myoid/recording/force_plate.h"
#include "myoid/tables/marker_file.h"

namespace myoid::recording {

/// The markers of a file, read in the format of its ending (`format_of`). Throws ReadError where
/// the format or the file holds none.
[[nodiscard]] MarkerFile read_markers(const std::filesystem::path& path);

/// One trial as measured: what a single file holds of it, in SI, on the file's own clock, in the
/// laboratory's frame. Parts that the file does not have are empty.
struct Recording {
  MarkerSeries markers;
  AnalogChannels analog;  ///< EMG and all others; one without a known unit is dimensionless.
  std::vector<AnalogChannels> other_clocks;  ///< Channels that have a clock of their own.
  std::vector<PlateSetup> plates;
  std::optional<Vec3> screen_up_L;  ///< Which way is up by POINT:Y_SCREEN of a .c3d file.
  std::vector<Event> events;
  std::vector<Repair> repairs;

  /// `analog` and each of `other_clocks`.
  [[nodiscard]] std::vector<const AnalogChannels*> clocks() const;

  /// A plate over time: 13 doubles a sample, so one after the other where the file is large.
  [[nodiscard]] ForcePlate force_plate(const PlateSetup& plate) const;
  [[nodiscard]] std::vector<ForcePlate> force_plates() const;
};

/// Everything in a recording, read in the format of its ending (`format_of`). Channels of a storage
/// file (.sto, .mot) have no unit. Throws ReadError.
[[nodiscard]] Recording read_recording(const std::filesystem::path& path);

/// "line 3: message", or the message alone where a repair has no line.
[[nodiscard]] std::string to_string(const Repair& repair);

/// "flex.sto:3: message", or "flex.sto: message" where it has none: a repair of this file.
[[nodiscard]] std::string to_string(const std::filesystem::path& path, const Repair& repair);

}  // namespace myoid::recording
