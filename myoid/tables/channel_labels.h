#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/tables/table_layout.h"

/// What the cells of a table's header say: names, units, rates, and which column is a clock.
namespace myoid::recording {

/// A name with what stands behind it taken off: "name [mV]", "name (mV)", "name, mV", "[mV]" give
/// the unit, "name (1259Hz)" the rate.
[[nodiscard]] TableColumn take_label_apart(const std::string& text);

/// The unit in a cell of its own, with or without brackets.
[[nodiscard]] std::optional<ScaledUnit> unit_in_cell(std::string_view cell);

/// "1259.2593 Hz".
[[nodiscard]] std::optional<double> rate_in_cell(std::string_view cell);

/// The number behind a word that means a sampling rate, anywhere in a line.
[[nodiscard]] std::optional<double> rate_in_line(std::string_view line);

/// Gives every column its kind by its name: times, numbers of frames and samples, remarks. A second
/// time column called just "t" or "T" is a channel (a trigger, a torque), unless the first has the
/// same name.
void set_kinds(std::vector<TableColumn>& columns);

/// A rate in whole Hz as one of wireless sensors that send whole numbers of samples in 27 ms:
/// 1259 Hz is 34 / 0.027 s. The rate itself where none is within half a Hz.
[[nodiscard]] double packet_rate(double rate_hz);

/// Where two channels have one name: the name of their device before it, with a note. `devices` are
/// cells of a row above the names; one that is empty belongs to the last before it.
void put_devices_before_names(TableLayout& layout, const std::vector<std::string>& devices);

}  // namespace myoid::recording
