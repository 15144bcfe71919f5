#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/tables/table_layout.h"

/// Reads the cells of a table's header: names, units, rates, and which column is a clock.
namespace myoid::recording {

/// Splits a label into name, unit and rate: "name [mV]", "name (mV)", "name, mV" and "[mV]" give
/// the unit, "name (1259Hz)" the rate.
[[nodiscard]] TableColumn take_label_apart(const std::string& text);

/// Returns the unit of a cell that holds nothing else, with or without brackets.
[[nodiscard]] std::optional<ScaledUnit> unit_in_cell(std::string_view cell);

/// Reads a rate such as "1259.2593 Hz" or "2 kHz" [Hz].
[[nodiscard]] std::optional<double> rate_in_cell(std::string_view cell);

/// A rate that a line states.
struct StatedRate {
  double hz = 0.0;
  std::string other_unit;  ///< MHz, GHz or a time (ms, us, ns) in place of Hz and kHz; `hz` is 0 then.
};

/// Finds the number behind a word that means a sampling rate, anywhere in a line. A number alone is in Hz.
[[nodiscard]] std::optional<StatedRate> rate_in_line(std::string_view line);

/// Gives every column its kind by its name: times, numbers of frames and samples, remarks. A second time column called
/// just "t" or "T" counts as a channel (a trigger, a torque), unless the first has the same name.
void set_kinds(std::vector<TableColumn>& columns);

/// Returns the exact rate of a wireless sensor whose rate is stated in whole Hz. Such sensors send whole numbers of
/// samples in 27 ms: 1259 Hz stands for 34 / 0.027 s. Returns the rate itself where no such rate is within half a Hz.
[[nodiscard]] double packet_rate(double rate_hz);

/// Makes names unique: where two channels share a name, the name of the device goes before it, with a note. `devices`
/// are cells of a row above the names; an empty cell repeats the last device before it.
void put_devices_before_names(TableLayout& layout, const std::vector<std::string>& devices);

}  // namespace myoid::recording
