#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/recording/tables/table_layout.h"

/// Reads the cells of a table's header: names, units, rates, and which column is a clock.
namespace myoid::recording {

/// Splits a label into name, unit and rate: "name [mV]", "name (mV)", "name, mV" and "[mV]" give
/// the unit, "name (1259Hz)" the rate.
[[nodiscard]] TableColumn take_label_apart(const std::string& text);

/// Splits the labels of a row. A whole number in brackets is an index, not the unit "1", where it stands against the
/// name ("C7[1]") or where another label has the same name and another number ("EMG [1]", "EMG [2]").
[[nodiscard]] std::vector<TableColumn> take_labels_apart(const std::vector<std::string>& texts);

/// Returns true for the pattern of written times that stands in place of a unit: "yyyy/mm/dd hh:mm:ss.000".
[[nodiscard]] bool is_pattern_of_times(std::string_view cell);

/// Returns the unit of a cell that holds nothing else, with or without brackets.
[[nodiscard]] std::optional<ScaledUnit> unit_in_cell(std::string_view cell);

/// Reads a number of Hz or kHz [Hz], also one that is no rate: "-1 Hz" of a sensor without a fixed rate.
[[nodiscard]] std::optional<double> hertz_in_cell(std::string_view cell);

/// Reads a rate such as "1259.2593 Hz" or "2 kHz" [Hz].
[[nodiscard]] std::optional<double> rate_in_cell(std::string_view cell);

/// Reads a sample period such as "0.000794 s", "0,5 ms" [s].
[[nodiscard]] std::optional<double> period_in_cell(std::string_view cell);

/// A rate that a line states.
struct StatedRate {
  double hz = 0.0;
  std::string other_unit;   ///< MHz, GHz, bpm or a time (ms, us, ns) in place of Hz and kHz; `hz` is 0 then.
  bool of_samples = false;  ///< The line speaks of samples ("sampling rate"), not only of a rate or frequency.
  std::size_t line = 0;     ///< Counted from 1.
};

/// Finds the number behind a word that means a sampling rate, anywhere in a line. A number alone is in Hz. "Heart rate"
/// and "cut-off frequency" are none.
[[nodiscard]] std::optional<StatedRate> rate_in_line(std::string_view line);

/// Returns the rates that the lines state: those of samples, else all.
[[nodiscard]] std::vector<StatedRate> rates_in_lines(std::span<const std::string_view> lines);

/// Returns the column of the clock by its name ("time", "Zeit", "timestamp", "t") and its unit, a time or none. A
/// column called just "t" or "T" may be a trigger or a torque: it is the clock where no other column is.
[[nodiscard]] std::optional<std::size_t> plain_clock(const std::vector<TableColumn>& columns);

/// Gives every column its kind by its name: times, numbers of frames and samples, remarks. A table has one clock, or a
/// clock for each channel ("X[s]", "EMG 1 Time Series (s)", "Time" repeated). A further column with the name of a
/// clock is a channel, with a note.
void set_kinds(TableLayout& layout);

/// Returns the exact rate of a wireless sensor whose rate is stated in whole Hz. Such sensors send whole numbers of
/// samples in 27 ms: 1259 Hz stands for 34 / 0.027 s. Returns the rate itself where no such rate is within half a Hz.
[[nodiscard]] double packet_rate(double rate_hz);

/// Makes names unique: where two channels share a name, the name of the device goes before it, with a note. `devices`
/// are cells of a row above the names; an empty cell repeats the last device before it.
void put_devices_before_names(TableLayout& layout, const std::vector<std::string>& devices);

}  // namespace myoid::recording
