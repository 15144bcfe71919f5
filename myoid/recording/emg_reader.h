#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/recording/text_file.h"

namespace myoid::recording {

struct EmgFile {
  TimeSeries data;               ///< Volts, or dimensionless if `dimensionless` was asked for.
  std::vector<Repair> repairs;
};

/// EMG from .sto, .mot or .csv. Raw EMG must have a unit: `unit` if given ("uV"), else the one that the file names (a column
/// "name [mV]", or a word such as microvolt, uV, mV, volt in the title); where there is none, ReadError says how to give it.
/// With `dimensionless` (envelopes, activations) no unit is looked for.
[[nodiscard]] EmgFile read_emg(const std::filesystem::path& path, const std::string& unit, bool dimensionless);

}  // namespace myoid::recording
