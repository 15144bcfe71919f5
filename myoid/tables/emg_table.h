#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/tables/csv_reader.h"

namespace myoid::recording {

/// A table of channels over time as EMG programs export it. A plain one (a header row, then
/// numbers) is read by `parse_csv_series`, one of a maker's own by `makers_layout`. Otherwise the
/// first rows of nothing but numbers are looked for; above them stand the names, perhaps rows of
/// units and of rates, and lines of free text, in which a sampling rate ("Frequency;1500",
/// "Sampling rate: 2000 Hz"), a number of rows, a length and per-channel lines ("Label: EMG 1
/// Sampling frequency: 1926 Unit: V") are understood. Understood as well, with a note:
///
///   - a time column for each channel ("X [s]"), or a rate for each: channels of the same clock are
///     joined, each other clock has its own series;
///   - no time column, if the rate is stated;
///   - columns of frame or sample numbers, which are compared with the rows;
///   - columns of remarks ("Activity", "Marker"), whose cells become events;
///   - units behind a comma ("BICEPS, uV");
///   - channels that end before the others: all of their clock are cut to the shortest.
///
/// Throws ReadError with the line if there is no such table, no clock, or a cell is no number.
[[nodiscard]] CsvSeries read_emg_table(const std::filesystem::path& path);
[[nodiscard]] CsvSeries parse_emg_table(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::recording
