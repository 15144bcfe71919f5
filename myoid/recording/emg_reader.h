#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::recording {

struct EmgFile {
  TimeSeries data;                                   ///< Volts, or dimensionless if `dimensionless` was asked for.
  std::map<std::string, std::string> target_muscle;  ///< By channel; from EMG-BIDS.
  std::vector<Repair> repairs;
  std::string unit_conflict;  ///< Empty, or a note that the given `unit` differs from the file's.
};

/// Returns the volts per number of a storage file if a word of its title or a header key `unit`
/// states them ("microvolt": 1e-6).
[[nodiscard]] std::optional<double> stated_voltage(const Storage& storage);
/// Returns "uV" for 1e-6.
[[nodiscard]] std::string voltage_name(double to_volt);

/// Reads EMG of the formats that `file_formats` marks. Raw EMG must have a unit: of its channel ("name [mV]"), of the
/// file (`stated_voltage`), or else `unit` ("uV"), which also holds where no amplifier gives the stated volts
/// (`is_beyond_amplifiers`). Without one, ReadError says how to give it. Left out with a note are
/// channels in newtons or the like, channels of force plates (FORCE_PLATFORM:CHANNEL) and channels named like another
/// instrument's (`named_as_no_emg`). With `dimensionless` (envelopes, activations) no unit is needed. With `wanted`,
/// only the channels that `choose_channels` finds are read: the others need no unit.
[[nodiscard]] EmgFile read_emg(const std::filesystem::path& path,
                               const std::string& unit,
                               bool dimensionless,
                               const std::vector<std::string>& wanted = {});

}  // namespace myoid::recording
