#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/recording/text_file.h"

namespace myoid::recording {

struct EmgFile {
  TimeSeries data;  ///< Volts, or dimensionless if `dimensionless` was asked for.
  std::map<std::string, std::string> target_muscle;  ///< By channel; of EMG-BIDS.
  std::vector<Repair> repairs;
};

/// EMG from .c3d, .edf, .bdf, .anc, .sto, .mot or a table (.csv, .tsv, .txt; see `read_emg_table`).
/// Raw EMG must have a unit: that of its channel ("name [mV]"), else `unit` if given ("uV"), else a
/// word in the title or a header key `unit` (microvolt, uV, mV, volt, ...); where there is none,
/// ReadError says how to give it. Channels in newtons or the like are left out, with a note. With
/// `dimensionless` (envelopes, activations) no unit is looked for.
[[nodiscard]] EmgFile read_emg(const std::filesystem::path& path,
                               const std::string& unit,
                               bool dimensionless);

}  // namespace myoid::recording
