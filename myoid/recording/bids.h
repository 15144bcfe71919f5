#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/files/marker_series.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {

/// A row of a BIDS `_channels.tsv`; "n/a" is read as empty.
struct BidsChannel {
  std::string name, type, unit;
  std::string component, tracked_point;  ///< Motion-BIDS: x, y, z of what.
  std::string target_muscle;             ///< EMG-BIDS.
  bool bad = false;                      ///< status
};

/// The `_channels.tsv` that belongs to a data file: same name up to the suffix, in its folder. EMG
/// data without one give nothing; motion data need theirs. Throws ReadError with the line where
/// name, type or units are missing.
[[nodiscard]] std::optional<std::vector<BidsChannel>> bids_channels_of(
    const std::filesystem::path& data);

/// A `_motion.tsv`: no header row, a column for each row of its channels, rate from the
/// `_motion.json`.
struct BidsMotion {
  MarkerSeries
      markers;        ///< Of the POS channels, in meters; a point without x, y and z is left out.
  TimeSeries angles;  ///< Of the JNTANG channels, in radians.
  std::vector<Repair> repairs;
};

/// Reads a Motion-BIDS recording. "n/a" and NaN are gaps. Throws ReadError where the columns are
/// not as many as the channels, a cell is no number, a unit is no length or angle, or the rate is
/// missing.
[[nodiscard]] BidsMotion read_bids_motion(const std::filesystem::path& path);

}  // namespace myoid::recording
