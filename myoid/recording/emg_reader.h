#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/files/text_file.h"
#include "myoid/tables/storage_reader.h"

namespace myoid::recording {

struct EmgFile {
  TimeSeries data;  ///< Volts, or dimensionless if `dimensionless` was asked for.
  std::map<std::string, std::string> target_muscle;  ///< By channel; of EMG-BIDS.
  std::vector<Repair> repairs;
  std::string unit_conflict;  ///< Empty, or that the `unit` given is not the one the file states.
};

/// Volts per number of a storage file, if a word of its title or a header key `unit` says it
/// ("microvolt": 1e-6).
[[nodiscard]] std::optional<double> stated_voltage(const Storage& storage);
/// "uV" for 1e-6.
[[nodiscard]] std::string voltage_name(double to_volt);

/// EMG from .c3d, .edf, .bdf, .anc, .sto, .mot or a table (.csv, .tsv, .txt; see `read_emg_table`).
/// Raw EMG must have a unit: that of its channel ("name [mV]") or of the file (`stated_voltage`),
/// else `unit` if given ("uV"); where there is none, ReadError says how to give it. Channels in
/// newtons or the like, those of force plates (FORCE_PLATFORM:CHANNEL) and those called like
/// another instrument's (`named_as_no_emg`) are left out, with a note. With `dimensionless`
/// (envelopes, activations) no unit is looked for. With `wanted`, only those channels are looked
/// at, as `choose_channels` finds them: the others need no unit.
[[nodiscard]] EmgFile read_emg(const std::filesystem::path& path,
                               const std::string& unit,
                               bool dimensionless,
                               const std::vector<std::string>& wanted = {});

}  // namespace myoid::recording
