#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// A row of a BIDS `_channels.tsv`; "n/a" is read as empty.
struct BidsChannel {
  std::string name, type, unit;
  std::string component,
      tracked_point;          ///< Motion-BIDS: axis (x, y, z) and the point it belongs to.
  std::string target_muscle;  ///< EMG-BIDS.
  bool bad = false;           ///< Column "status".
  double rate_hz = 0.0;       ///< Column "sampling_frequency"; 0: not stated.
};

/// Reads the `_channels.tsv` of a data file, which has the same folder and the same name up to the
/// suffix. Returns nothing for EMG data without such a file; motion data need one. Throws ReadError
/// with the line where name, type or units are missing.
[[nodiscard]] std::optional<std::vector<BidsChannel>> bids_channels_of(const std::filesystem::path& data);

/// A `_motion.tsv`: no header row, one column for each row of its `_channels.tsv`. Its clock is the LATENCY channel or,
/// without one, the rate of the `_motion.json`. A rate that another file states is a repair.
struct BidsMotion {
  MarkerSeries markers;  ///< POS channels in meters; a point without x, y and z is left out.
  TimeSeries angles;     ///< JNTANG channels in radians.
  std::vector<Repair> repairs;
};

/// Reads a Motion-BIDS recording. "n/a" and NaN are gaps. Throws ReadError where the numbers of columns and channels
/// differ, a cell is no number, a unit is neither length nor angle, latencies do not increase, or the rate is missing.
[[nodiscard]] BidsMotion read_bids_motion(const std::filesystem::path& path);

}  // namespace myoid::recording
