#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/recording/csv_reader.h"

namespace myoid::recording {

/// A table of channels over time as EMG programs export it. A plain one (a header row, then
/// numbers) is read by `parse_csv_series`. Otherwise the first rows of nothing but numbers are
/// looked for; above them stand the names, perhaps a row of units, and lines of free text, in which
/// a sampling rate ("Frequency;1500", "Sampling rate: 2000 Hz") and per-channel lines ("Label: EMG
/// 1 Sampling frequency: 1926 Unit: V") are understood. Understood as well, with a note:
///
///   - a time column for each channel ("X [s]"): channels of the same clock are joined; those of
///     other rates than that of the channels in volts (or else of the first) are left out;
///   - no time column, if the rate is stated;
///   - columns of frame or sample numbers, which are left out;
///   - units behind a comma ("BICEPS, uV");
///   - channels that end before the others: all are cut to the shortest.
///
/// Throws ReadError with the line if there is no such table, no clock, or a cell is no number.
[[nodiscard]] CsvSeries read_emg_table(const std::filesystem::path& path);
[[nodiscard]] CsvSeries parse_emg_table(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::recording
