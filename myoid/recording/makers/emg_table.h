#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/recording/tables/csv_reader.h"

namespace myoid::recording {

/// Reads a table of channels over time as EMG programs export it. `parse_csv_series` reads plain tables (a header row,
/// then numbers); `makers_layout` knows the formats of single makers. In all others the reader looks for the first rows
/// that hold only numbers. Above them stand the names, perhaps rows of units and of rates, and lines of free text. The
/// free text may state a sampling rate ("Frequency;1500", "Sampling rate: 2000 Hz"), a number of rows, a length, and
/// lines about one channel ("Label: EMG 1 Sampling frequency: 1926 Unit: V"). Also read, with a note:
///
///   - a time column for each channel ("X [s]"), or a rate for each: channels of the same clock are
///     joined, each other clock becomes a series of its own;
///   - no time column, if the rate is stated;
///   - columns of frame or sample numbers, which are compared with the rows;
///   - columns of remarks ("Activity", "Marker"), whose cells become events;
///   - units behind a comma ("BICEPS, uV");
///   - channels that end early: all channels of their clock are cut to the shortest.
///
/// Throws ReadError with the line if there is no such table, no clock, or a cell is no number.
[[nodiscard]] CsvSeries parse_emg_table(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::recording
